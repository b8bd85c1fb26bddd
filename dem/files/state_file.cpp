#include "dem/files/state_file.hpp"

#include <fstream>
#include <limits>
#include <span>
#include <stdexcept>
#include <type_traits>

#include "dem/disks/physical_hash.hpp"
#include "dem/disks/state_check.hpp"
#include "dem/disks/state_layout.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/files/hdf5_image.hpp"
#include "dem/files/state_layout.hpp"
#include "dem/files/state_seal.hpp"
#include "dem/input_error.hpp"
#include "dem/scene/file.hpp"
#include "dem/scene/text.hpp"

namespace isostat {
namespace {

#if defined(__clang__)
const char* const kCompiler = "clang " __clang_version__;
#else
const char* const kCompiler = "g++ " __VERSION__;
#endif

// How an element of an array lies in the file: its scalar type and how many of them.
template <class T>
struct Element {
  using Scalar = T;
  static constexpr std::size_t width = 1;
};
template <>
struct Element<Vec2> {  // two numbers side by side
  using Scalar = double;
  static constexpr std::size_t width = 2;
};
template <>
struct Element<std::array<std::int32_t, 2>> {
  using Scalar = std::int32_t;
  static constexpr std::size_t width = 2;
};

template <class T>
Shape shape_of(std::size_t count) {
  return Element<T>::width == 1 ? Shape{count} : Shape{count, Element<T>::width};
}

// The extra leading 1 of an H5MD time series of one frame.
Shape in_one_frame(Shape shape) {
  shape.insert(shape.begin(), 1);
  return shape;
}

class StateWriter {
 public:
  static constexpr bool writes = true;
  StateWriter(Hdf5Writer& file, double time, std::int64_t step) : file_(file), time_(time), step_(step) {}

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
  void box(const std::string& path, const std::optional<PeriodicCell<2>>& cell) {
    file_.group(path);
    file_.attribute(path, "dimension", std::int64_t{2});
    file_.attribute(path, "boundary", std::vector<std::string>(2, cell ? "periodic" : "none"));
    if (!cell) return;
    frame(path + "/edges");
    write(path + "/edges/value", {1, 2}, std::vector<Vec2>{cell->length}, "a");
  }

  void value(const std::string& group, const std::string& name, double x) { put(group, name, x); }
  void value(const std::string& group, const std::string& name, std::int64_t n) { put(group, name, n); }
  void value(const std::string& group, const std::string& name, std::uint64_t n) { put(group, name, n); }
  void value(const std::string& group, const std::string& name, std::int32_t n) { put(group, name, std::int64_t{n}); }
  void value(const std::string& group, const std::string& name, bool b) { put(group, name, std::int64_t{b}); }
  void value(const std::string& group, const std::string& name, const Vec2& v) {
    put(group, name, std::span<const double>(v.c));
  }
  void value(const std::string& group, const std::string& name, const std::string& text) {
    file_.group(group);
    file_.attribute(group, name, std::string_view(text));
  }
  void value(const std::string& group, const std::string& name, const std::optional<double>& x) {
    if (x) put(group, name, *x);
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
    file_.array<double>(path + "/time", {1}, std::span(&time_, 1), "T0");
  }
  template <class T>
  void write(const std::string& path, const Shape& shape, const std::vector<T>& values, const char* unit) {
    using Scalar = typename Element<T>::Scalar;
    if constexpr (Element<T>::width == 1) {
      file_.array<Scalar>(path, shape, values, unit);
    } else {
      std::vector<Scalar> flat;
      flat.reserve(values.size() * Element<T>::width);
      for (T v : values)
        for (int k = 0; k < static_cast<int>(Element<T>::width); ++k) flat.push_back(v[static_cast<decltype(k)>(k)]);
      file_.array<Scalar>(path, shape, flat, unit);
    }
  }

  Hdf5Writer& file_;
  double time_;
  std::int64_t step_;
};

class StateReader {
 public:
  static constexpr bool writes = false;
  StateReader(const Hdf5Reader& file, const std::string& path) : file_(file), path_(path) {}

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
  void box(const std::string& path, std::optional<PeriodicCell<2>>& cell) {
    if (file_.attribute<std::int64_t>(path, "dimension") != 2) throw Hdf5Error(path + "@dimension", "is not 2");
    const std::string boundary = file_.text_attribute(path, "boundary", 2);
    if (boundary == "none") return;
    if (boundary != "periodic") throw Hdf5Error(path + "@boundary", "is neither periodic nor none in both directions");
    const std::vector<double> edges = file_.array<double>(path + "/edges/value", {1, 2});
    cell = PeriodicCell<2>{{{edges[0], edges[1]}}};
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
  void value(const std::string& group, const std::string& name, Vec2& v) {
    const std::vector<double> x = file_.attributes<double>(group, name, 2);
    v = {{x[0], x[1]}};
  }
  void value(const std::string& group, const std::string& name, std::string& text) {
    text = file_.text_attribute(group, name);
  }
  void value(const std::string& group, const std::string& name, std::optional<double>& x) {
    if (file_.has_attribute(group, name)) x = file_.attribute<double>(group, name);
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
    auto flat = file_.array<typename Element<T>::Scalar>(path, shape);
    if constexpr (Element<T>::width == 1) {
      values = std::move(flat);
    } else {
      values.resize(count);
      for (std::size_t k = 0; k < count; ++k)
        for (int c = 0; c < 2; ++c) values[k][static_cast<std::size_t>(c)] = flat[2 * k + static_cast<std::size_t>(c)];
    }
  }

  const Hdf5Reader& file_;
  const std::string& path_;
};

const char* const kFormat = "isostat state";

template <class System>
StateFile decode(const Hdf5Reader& file, const std::string& path, int sealed_version) {
  if (const std::string format = file.text_attribute("/", "format"); format != kFormat)
    throw InputError(path, 0, "/@format", format, "expected \"" + std::string(kFormat) + "\"");
  if (const auto version = file.attribute<std::int64_t>("/", "format_version"); version != sealed_version)
    throw InputError(path, 0, "format_version", std::to_string(version),
                     "the seal says " + std::to_string(sealed_version));
  StateFile result;
  State<System> state;
  StateReader reader(file, path);
  transfer(reader, state);
  reader.value("/provenance", "version", result.provenance.version);
  reader.value("/provenance", "compiler", result.provenance.compiler);
  reader.value("/provenance", "command", result.provenance.command);
  if (const auto fault = state_fault(state)) throw InputError(path, 0, fault->field, "", fault->rule);
  result.hash = physical_hash(state);
  if (const std::string stored = file.text_attribute("/", "hash"); stored != result.hash)
    throw InputError(path, 0, "hash", stored, "the physical state has the hash " + result.hash);
  result.state = std::move(state);
  return result;
}

}  // namespace

template <class System>
std::string encode_state(const State<System>& state, Provenance provenance) {
  if (const auto fault = state_fault(state))
    throw std::invalid_argument("a state that cannot be kept: " + fault->field + ": " + fault->rule);
  if (provenance.compiler.empty()) provenance.compiler = kCompiler;
  std::string image;
  {
    Hdf5Writer file(kSealBytes);
    file.attribute("/", "format", std::string_view(kFormat));
    file.attribute("/", "format_version", std::int64_t{kStateFormatVersion});
    file.attribute("/", "hash", std::string_view(physical_hash(state)));
    file.group("/h5md/author");
    file.group("/h5md/creator");
    constexpr std::int64_t kH5mdVersion[] = {1, 1};
    file.attribute("/h5md", "version", std::span<const std::int64_t>(kH5mdVersion));
    file.attribute("/h5md/author", "name", std::string_view("unknown"));  // H5MD wants one; we keep no names
    file.attribute("/h5md/creator", "name", std::string_view("isostat"));
    file.attribute("/h5md/creator", "version", std::string_view(provenance.version));
    StateWriter writer(file, state.time, state.step);
    transfer(writer, const_cast<State<System>&>(state));  // a writer only looks
    writer.value("/provenance", "version", provenance.version);
    writer.value("/provenance", "compiler", provenance.compiler);
    writer.value("/provenance", "command", provenance.command);
    image = file.finish();
  }
  seal_state(image);
  return image;
}

std::string encode_state(const AnyState& any, Provenance provenance) {
  return std::visit([&](const auto& state) { return encode_state(state, std::move(provenance)); }, any);
}

StateFile decode_state(std::string_view image, const std::string& path) {
  const int version = check_seal(image, path);
  try {
    return decode<Disks>(Hdf5Reader(image), path, version);  // files without /@system are of disks
  } catch (const Hdf5Error& error) {
    throw InputError(path, 0, error.path, "", error.what());
  }
}

template <class System>
void write_state(const State<System>& state, const std::string& path, Provenance provenance) {
  write_file_atomically(path, encode_state(state, std::move(provenance)));
}

StateFile read_state_file(const std::string& path) { return decode_state(read_whole_file(path), path); }

AnyState read_state(const std::string& path) { return read_state_file(path).state; }

template <class System>
State<System> read_state(const std::string& path) {
  AnyState any = read_state(path);
  if (auto* state = std::get_if<State<System>>(&any)) return std::move(*state);
  throw InputError(path, 0, "system", "", "a state of " + std::string(System::name) + " is wanted");
}

bool is_state_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string head(kSealBytes, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return begins_like_state(head);
}

template std::string encode_state(const State<Disks>&, Provenance);
template void write_state(const State<Disks>&, const std::string&, Provenance);
template State<Disks> read_state(const std::string&);

}  // namespace isostat
