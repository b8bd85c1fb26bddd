#include "dem/triangles/grain_shape.hpp"

#include <charconv>
#include <cmath>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <numbers>
#include <string_view>

#include "dem/files/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "dem/scene/suggestion.hpp"
#include "dem/scene/text.hpp"
#include "geometry/base/index.hpp"
#include "geometry/polygon_triangulation.hpp"

namespace isostat {
namespace {

constexpr int kMostSides = 64;
constexpr double kRightTurn = std::numbers::pi / 2;

Vec2 on_circle(double radius, double angle) { return {{radius * std::cos(angle), radius * std::sin(angle)}}; }

// Unit squares of a lattice, each cut by its diagonals, scaled to this side.
TriangleMesh squares(double side, std::initializer_list<std::array<int, 2>> places) {
  TriangleMesh mesh;
  std::map<std::array<int, 2>, std::int32_t> corners;
  const auto add = [&](double x, double y) {
    mesh.points.push_back({{x * side, y * side}});
    return static_cast<std::int32_t>(mesh.points.size()) - 1;
  };
  for (const auto& [x, y] : places) {
    std::array<std::int32_t, 4> around;  // anticlockwise from the lower left
    constexpr std::array<std::array<int, 2>, 4> to{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::array<int, 2> at{x + to[k][0], y + to[k][1]};
      const auto [found, fresh] = corners.emplace(at, 0);
      if (fresh) found->second = add(at[0], at[1]);
      around[k] = found->second;
    }
    const std::int32_t centre = add(x + 0.5, y + 0.5);
    for (std::size_t k = 0; k < 4; ++k) mesh.triangles.push_back({around[k], around[(k + 1) % 4], centre});
  }
  return mesh;
}

// A strip of squares on one line; its triangles make a chain without branches.
TriangleMesh strip(double side, std::int32_t length) {
  TriangleMesh mesh;
  for (std::int32_t x = 0; x <= length; ++x)
    for (const int y : {0, 1}) mesh.points.push_back({{x * side, y * side}});
  for (std::int32_t x = 0; x < length; ++x) {
    const std::int32_t low = 2 * x, high = low + 1, next_low = low + 2, next_high = low + 3;
    if (x % 2 == 0) {
      mesh.triangles.push_back({low, next_high, high});
      mesh.triangles.push_back({low, next_low, next_high});
    } else {
      mesh.triangles.push_back({low, next_low, high});
      mesh.triangles.push_back({next_low, next_high, high});
    }
  }
  return mesh;
}

TriangleMesh triangle(double side) {
  const double height = side * std::numbers::sqrt3 / 2;
  return {{{{0, 0}}, {{side, 0}}, {{side / 2, height}}}, {{0, 1, 2}}};
}

TriangleMesh regular_polygon(int sides, double side) {
  if (sides == 4) return squares(side, {{0, 0}});
  const double sector = 2 * std::numbers::pi / sides, radius = side / (2 * std::sin(sector / 2));
  TriangleMesh mesh;
  for (int k = 0; k < sides; ++k) {
    mesh.points.push_back(on_circle(radius, (k - 0.5) * sector - kRightTurn));  // the first side lies at the bottom
    mesh.triangles.push_back({k, (k + 1) % sides, sides});
  }
  mesh.points.push_back({});
  return mesh;
}

// The inner corners lie where the sides of a pentagram cross: at sin 18 / sin 54 of the outer radius.
TriangleMesh star(double diameter) {
  constexpr std::int32_t tips = 5, centre = 2 * tips;
  const double sector = 2 * std::numbers::pi / tips, outer = diameter / 2,
               inner = outer * std::sin(sector / 4) / std::sin(3 * sector / 4);
  TriangleMesh mesh;
  for (int k = 0; k < tips; ++k) mesh.points.push_back(on_circle(outer, kRightTurn + k * sector));
  for (int k = 0; k < tips; ++k) mesh.points.push_back(on_circle(inner, kRightTurn + (k + 0.5) * sector));
  mesh.points.push_back({});
  for (std::int32_t k = 0; k < tips; ++k) {
    const std::int32_t before = tips + (k + tips - 1) % tips, after = tips + k;  // inner corners beside tip k
    mesh.triangles.push_back({before, after, centre});
    mesh.triangles.push_back({before, k, after});
  }
  return mesh;
}

std::optional<double> real(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

struct Corners {
  std::vector<Vec2> at;
  std::vector<int> line;  // of the file
};

Corners read_corners(const std::string& path) {
  constexpr std::string_view space = " \t\r\v\f,";
  const std::string text = read_whole_file(path);
  Corners corners;
  std::vector<Fault> faults;
  int number = 0;
  for (std::size_t at = 0; at < text.size(); ++number) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    std::string_view line = std::string_view(text).substr(at, end - at);
    at = end + 1;
    line = line.substr(0, line.find('#'));
    std::vector<std::string_view> fields;
    for (std::size_t from = line.find_first_not_of(space); from != std::string_view::npos;) {
      const std::size_t to = std::min(line.find_first_of(space, from), line.size());
      fields.push_back(line.substr(from, to - from));
      from = line.find_first_not_of(space, to);
    }
    if (fields.empty()) continue;
    const auto x = real(fields[0]), y = fields.size() == 2 ? real(fields[1]) : std::nullopt;
    if (x && y)
      corners.at.push_back({{*x, *y}}), corners.line.push_back(number + 1);
    else
      faults.push_back({path, number + 1, "corner", std::string(line), "two numbers, x y"});
  }
  if (!faults.empty()) throw InputError(std::move(faults));
  if (corners.at.size() > kMostCorners)
    throw InputError(path, 0, "corners", std::to_string(corners.at.size()), "at most " + std::to_string(kMostCorners));
  return corners;
}

TriangleMesh polygon_of_file(const std::string& path, double factor, double refine) {
  Corners corners = read_corners(path);
  for (Vec2& p : corners.at) p = factor * p;
  if (const auto fault = polygon_fault(corners.at)) {
    const int line = corners.line.empty() ? 0 : corners.line[fault->first];
    throw InputError(path, line, "corner", std::to_string(fault->first + 1), describe(*fault));
  }
  if (refine > 0) {
    double doubled = 0;  // area
    for (std::size_t k = 2; k < corners.at.size(); ++k)
      doubled += doubled_area(corners.at[0], corners.at[k - 1], corners.at[k]);
    // an equilateral triangle of this edge has sqrt(3)/4 of its square
    if (std::abs(doubled) * 2 / (std::numbers::sqrt3 * refine * refine) > static_cast<double>(kMostTriangles))
      throw InputError(path, 0, "refine", real_text(refine),
                       "coarser: this gives more than " + std::to_string(kMostTriangles) + " triangles");
  }
  return triangulate_polygon(corners.at, refine);
}

const std::vector<std::string> kNames{"square", "triangle", "polygonN", "rod", "L", "star"};

std::optional<TriangleMesh> named_shape(const std::string& name, double size) {
  if (name == "square") return squares(size, {{0, 0}});
  if (name == "triangle") return triangle(size);
  if (name == "rod") return strip(size / 4, 4);
  if (name == "L") return squares(size / 2, {{0, 0}, {1, 0}, {0, 1}});
  if (name == "star") return star(size);
  constexpr std::string_view polygon = "polygon";
  if (!name.starts_with(polygon)) return std::nullopt;
  int sides = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + polygon.size(), end, sides);
  if (error != std::errc{} || stop != end) return std::nullopt;
  if (sides < 3 || sides > kMostSides) throw InputError("grain", 0, "shape", name, "polygon3 to polygon64");
  return regular_polygon(sides, size);
}

}  // namespace

TriangleMesh grain_shape(const std::string& name_or_file, std::optional<double> size, double refine) {
  if (size && !(*size > 0 && std::isfinite(*size))) throw InputError("grain", 0, "size", real_text(*size), "positive");
  if (auto mesh = named_shape(name_or_file, size.value_or(kGrainSize))) {
    if (refine > 0) throw InputError("grain", 0, "shape", name_or_file, "only the polygon of a file can be refined");
    return *std::move(mesh);
  }
  std::error_code none;
  if (name_or_file.find_first_of("./") == std::string::npos && !std::filesystem::exists(name_or_file, none)) {
    std::string rule = did_you_mean(name_or_file, kNames);
    if (rule.empty()) rule = "square, triangle, polygonN (polygon6), rod, L, star, or a file of corners";
    throw InputError("grain", 0, "shape", name_or_file, "neither a shape nor a file; " + rule);
  }
  return polygon_of_file(name_or_file, size.value_or(1), refine);
}

}  // namespace isostat
