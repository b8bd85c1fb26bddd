// How a state goes into an HDF5 image and comes out of it: what transfer() of dem/files/state_layout.hpp is given.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "dem/files/hdf5_image.hpp"
#include "dem/files/state_columns.hpp"
#include "dem/scene/file.hpp"
#include "dem/scene/text.hpp"
#include "geometry/periodic_cell.hpp"

namespace isostat {

// How an element of an array lies in the file: its scalar type, and the shape in which it has them side by side.
template <class T>
struct Element {
  using Scalar = T;
  static Shape shape() { return {}; }
};
template <class T>
requires std::is_enum_v<T>
struct Element<T> {
  using Scalar = std::underlying_type_t<T>;
  static Shape shape() { return {}; }
};
template <int D>
struct Element<Vec<D>> {
  using Scalar = double;
  static Shape shape() { return {D}; }
};
template <class T, std::size_t N>
struct Element<std::array<T, N>> {
  using Scalar = typename Element<T>::Scalar;
  static Shape shape() {
    Shape inner = Element<T>::shape();
    inner.insert(inner.begin(), N);
    return inner;
  }
};

template <class T>
Shape shape_of(std::size_t count) {
  Shape shape = Element<T>::shape();
  shape.insert(shape.begin(), count);
  return shape;
}

// The extra leading 1 of an H5MD time series of one frame.
inline Shape in_one_frame(Shape shape) {
  shape.insert(shape.begin(), 1);
  return shape;
}

class StateWriter {
 public:
  static constexpr bool writes = true;
  StateWriter(Hdf5Writer& file, FileUnits units, double time, std::int64_t step)
      : file_(file), units_(units), time_(time), step_(step) {}

  bool since(int) const { return true; }
  std::size_t count(const std::string&, std::size_t size) const { return size; }

  template <class T>
  void array(const std::string& path, const std::vector<T>& values, std::size_t count, const char* unit) {
    write(path, shape_of<T>(count), values, unit);
  }
  template <class T>
  void element(const std::string& path, const std::vector<T>& values, std::size_t count, const char* unit) {
    frame(path);
    write(path + "/value", in_one_frame(shape_of<T>(count)), values, unit);
  }
  template <int D>
  void box(const std::string& path, const std::optional<PeriodicCell<D>>& cell) {
    file_.group(path);
    file_.attribute(path, "dimension", std::int64_t{D});
    file_.attribute(path, "boundary", std::vector<std::string>(D, cell ? "periodic" : "none"));
    if (!cell) return;
    frame(path + "/edges");
    write(path + "/edges/value", {1, D}, std::vector<Vec<D>>{cell->length}, units_.length);
    if (cell->tilt != 0) file_.attribute(path, "tilt", cell->tilt);
  }

  void value(const std::string& group, const std::string& name, double x) { put(group, name, x); }
  void value(const std::string& group, const std::string& name, std::int64_t n) { put(group, name, n); }
  void value(const std::string& group, const std::string& name, std::uint64_t n) { put(group, name, n); }
  void value(const std::string& group, const std::string& name, std::int32_t n) { put(group, name, std::int64_t{n}); }
  void value(const std::string& group, const std::string& name, bool b) { put(group, name, std::int64_t{b}); }
  template <int D>
  void value(const std::string& group, const std::string& name, const Vec<D>& v) {
    put(group, name, std::span<const double>(v.c));
  }
  void value(const std::string& group, const std::string& name, const std::string& text) {
    file_.group(group);
    file_.attribute(group, name, std::string_view(text));
  }
  void value(const std::string& group, const std::string& name, const std::optional<double>& x) {
    if (x) put(group, name, *x);
  }
  void text_if_any(const std::string& group, const std::string& name, const std::string& text) {
    if (!text.empty()) value(group, name, text);
  }
  void count_if_any(const std::string& group, const std::string& name, std::int64_t n) {
    if (n != 0) value(group, name, n);
  }
  void flag_if_any(const std::string& group, const std::string& name, bool flag) {
    if (flag) value(group, name, flag);
  }
  template <class Enum, std::size_t N>
  void choice(const std::string& group, const std::string& name, Enum e, const std::array<std::string_view, N>& names) {
    value(group, name, std::string(names[static_cast<std::size_t>(e)]));
  }
  void scene(const std::string& path, const Scene& scene) { file_.text(path, scene_to_toml(scene)); }

 private:
  template <class T>
  void put(const std::string& group, const std::string& name, T x) {
    file_.group(group);
    file_.attribute(group, name, x);
  }
  void frame(const std::string& path) {
    file_.array<std::int64_t>(path + "/step", {1}, std::span(&step_, 1));
    file_.array<double>(path + "/time", {1}, std::span(&time_, 1), units_.time);
  }
  template <class T>
  void write(const std::string& path, const Shape& shape, const std::vector<T>& values, const char* unit) {
    using Scalar = typename Element<T>::Scalar;
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % sizeof(Scalar) == 0);
    if constexpr (std::is_same_v<T, Scalar>) {
      file_.array<Scalar>(path, shape, values, unit);
    } else {
      std::vector<Scalar> flat(values.size() * (sizeof(T) / sizeof(Scalar)));
      if (!flat.empty()) std::memcpy(flat.data(), values.data(), flat.size() * sizeof(Scalar));
      file_.array<Scalar>(path, shape, flat, unit);
    }
  }

  Hdf5Writer& file_;
  FileUnits units_;
  double time_;
  std::int64_t step_;
};

class StateReader {
 public:
  static constexpr bool writes = false;
  StateReader(const Hdf5Reader& file, const std::string& path, int version)
      : file_(file), path_(path), version_(version) {}

  // Whether the file is of this format version or a later one.
  bool since(int version) const { return version_ >= version; }

  // Length of the array that the others are measured against.
  std::size_t count(const std::string& path, std::size_t) const {
    const Shape shape = file_.shape(path);
    if (shape.empty()) throw Hdf5Error(path, "is a scalar, expected an array");
    return shape[0];
  }

  template <class T>
  void array(const std::string& path, std::vector<T>& values, std::size_t count, const char*) {
    read(path, shape_of<T>(count), values, count);
  }
  template <class T>
  void element(const std::string& path, std::vector<T>& values, std::size_t count, const char*) {
    read(path + "/value", in_one_frame(shape_of<T>(count)), values, count);
  }
  template <int D>
  void box(const std::string& path, std::optional<PeriodicCell<D>>& cell) {
    if (file_.attribute<std::int64_t>(path, "dimension") != D)
      throw Hdf5Error(path + "@dimension", "is not " + std::to_string(D));
    const std::string boundary = file_.text_attribute(path, "boundary", D);
    if (boundary == "none") return;
    if (boundary != "periodic") throw Hdf5Error(path + "@boundary", "is neither periodic nor none in all directions");
    const std::vector<double> edges = file_.array<double>(path + "/edges/value", {1, D});
    cell.emplace();
    std::copy_n(edges.begin(), D, cell->length.c.begin());
    if (file_.has_attribute(path, "tilt")) cell->tilt = file_.attribute<double>(path, "tilt");
  }

  void value(const std::string& group, const std::string& name, double& x) { x = file_.attribute<double>(group, name); }
  void value(const std::string& group, const std::string& name, std::int64_t& n) {
    n = file_.attribute<std::int64_t>(group, name);
  }
  void value(const std::string& group, const std::string& name, std::uint64_t& n) {
    n = file_.attribute<std::uint64_t>(group, name);
  }
  void value(const std::string& group, const std::string& name, std::int32_t& n) {
    n = integer<std::int32_t>(group, name, std::numeric_limits<std::int32_t>::min(),
                              std::numeric_limits<std::int32_t>::max());
  }
  void value(const std::string& group, const std::string& name, bool& b) { b = integer<int>(group, name, 0, 1) != 0; }
  template <int D>
  void value(const std::string& group, const std::string& name, Vec<D>& v) {
    const std::vector<double> x = file_.attributes<double>(group, name, D);
    std::copy_n(x.begin(), D, v.c.begin());
  }
  void value(const std::string& group, const std::string& name, std::string& text) {
    text = file_.text_attribute(group, name);
  }
  void value(const std::string& group, const std::string& name, std::optional<double>& x) {
    if (file_.has_attribute(group, name)) x = file_.attribute<double>(group, name);
  }
  void text_if_any(const std::string& group, const std::string& name, std::string& text) {
    if (file_.has_attribute(group, name)) text = file_.text_attribute(group, name);
  }
  void count_if_any(const std::string& group, const std::string& name, std::int64_t& n) {
    if (file_.has_attribute(group, name)) value(group, name, n);
  }
  void flag_if_any(const std::string& group, const std::string& name, bool& flag) {
    flag = file_.has_attribute(group, name);
  }
  template <class Enum, std::size_t N>
  void choice(const std::string& group, const std::string& name, Enum& e,
              const std::array<std::string_view, N>& names) {
    const std::string text = file_.text_attribute(group, name);
    const auto found = std::find(names.begin(), names.end(), text);
    if (found == names.end()) throw Hdf5Error(group + "@" + name, "is \"" + text + "\", which is not known");
    e = static_cast<Enum>(found - names.begin());
  }
  void scene(const std::string& path, Scene& scene) {
    scene = parse_scene(file_.text(path), path_ + ":" + path, {}, SceneChecks::keys);
  }

 private:
  template <class T>
  T integer(const std::string& group, const std::string& name, std::int64_t low, std::int64_t high) const {
    const auto n = file_.attribute<std::int64_t>(group, name);
    if (n < low || n > high) throw Hdf5Error(group + "@" + name, "is out of range");
    return static_cast<T>(n);
  }
  template <class T>
  void read(const std::string& path, const Shape& shape, std::vector<T>& values, std::size_t count) {
    using Scalar = typename Element<T>::Scalar;
    auto flat = file_.array<Scalar>(path, shape);
    if constexpr (std::is_same_v<T, Scalar>) {
      values = std::move(flat);
    } else {
      values.resize(count);
      if (!flat.empty()) std::memcpy(static_cast<void*>(values.data()), flat.data(), flat.size() * sizeof(Scalar));
    }
  }

  const Hdf5Reader& file_;
  const std::string& path_;
  int version_;
};

}  // namespace isostat
