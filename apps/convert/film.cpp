#include "apps/convert/film.hpp"

#include <filesystem>

#include "dem/files/formats/dump.hpp"
#include "dem/files/formats/packing_header.hpp"
#include "dem/files/formats/pvd.hpp"
#include "dem/files/formats/vtp.hpp"
#include "dem/files/formats/xyz.hpp"
#include "dem/input_error.hpp"
#include "dem/spheres/vtp.hpp"
#include "dem/triangles/vtp.hpp"

namespace isostat {
namespace {

// What f says of each frame, if it increases; else 0, 1, 2, ...
template <class Number, class F>
std::vector<Number> increasing(const std::vector<AnyState>& frames, F&& f) {
  std::vector<Number> numbers;
  for (const AnyState& any : frames) numbers.push_back(std::visit(f, any));
  for (std::size_t k = 1; k < numbers.size(); ++k)
    if (!(numbers[k] > numbers[k - 1])) {
      for (std::size_t n = 0; n < numbers.size(); ++n) numbers[n] = static_cast<Number>(n);
      break;
    }
  return numbers;
}

std::string vtk_of(const AnyState& any, double time) {
  return std::visit([time](const auto& state) { return vtk_polydata(state.packing, time); }, any);
}

WrittenFiles pvd_files(const std::vector<AnyState>& frames, const std::string& path) {
  const auto times = increasing<double>(frames, [](const auto& s) { return s.time; });
  WrittenFiles files;
  std::vector<PvdFrame> list;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    files.emplace_back(pvd_frame_path(path, k + 1), vtk_of(frames[k], times[k]));
    list.push_back({times[k], std::filesystem::path(files.back().first).filename().string()});
  }
  files.emplace_back(path, pvd_collection(list));
  return files;
}

template <class F>
void of_grains(const AnyState& any, const std::string& path, F&& f) {
  if (const auto* disks = std::get_if<State<Disks>>(&any)) return f(*disks);
  if (const auto* spheres = std::get_if<State<Spheres>>(&any)) return f(*spheres);
  throw InputError("command line", 0, "-o", path, "triangles are drawn in .vtp and .pvd only");
}

}  // namespace

WrittenFiles film_files(const std::vector<AnyState>& frames, const std::string& path) {
  if (path.ends_with(".vtp"))
    return {{path, vtk_of(frames.front(), std::visit([](const auto& s) { return s.time; }, frames.front()))}};
  if (path.ends_with(".pvd")) return pvd_files(frames, path);
  std::string grains, links, header;
  const auto steps = increasing<std::int64_t>(frames, [](const auto& s) { return s.step; });
  for (std::size_t k = 0; k < frames.size(); ++k)
    of_grains(frames[k], path, [&](const auto& state) {
      if (path.ends_with(".xyz")) {
        grains += extended_xyz(state.packing, state.time);
        return;
      }
      grains += grains_dump(state.packing, steps[k]), links += links_dump(state.packing, steps[k]);
      header = header_text(state);
    });
  if (path.ends_with(".xyz")) return {{path, grains}};
  return {{path, grains}, {links_dump_path(path), links}, {header_path(path), header}};
}

}  // namespace isostat
