#include "dem/files/hdf5_image.hpp"

#include <hdf5.h>

#include <algorithm>
#include <mutex>
#include <utility>

namespace isostat {
namespace {

std::mutex& library_lock() {
  static std::mutex lock;
  return lock;
}

// An HDF5 identifier that closes itself. The library says what went wrong by a negative number.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);
  Handle() = default;
  Handle(hid_t id, Close how, const std::string& path, const char* reason) : id_(id), close_(how) {
    if (id < 0) throw Hdf5Error(path, reason);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
  Handle& operator=(Handle&& other) noexcept {
    std::swap(id_, other.id_), std::swap(close_, other.close_);
    return *this;
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  operator hid_t() const { return id_; }

 private:
  hid_t id_ = -1;
  Close close_ = nullptr;
};

void require(herr_t status, const std::string& path, const char* reason) {
  if (status < 0) throw Hdf5Error(path, reason);
}

template <class T>
hid_t file_type();
template <>
hid_t file_type<double>() {
  return H5T_IEEE_F64LE;
}
template <>
hid_t file_type<std::int32_t>() {
  return H5T_STD_I32LE;
}
template <>
hid_t file_type<std::int64_t>() {
  return H5T_STD_I64LE;
}
template <>
hid_t file_type<std::uint64_t>() {
  return H5T_STD_U64LE;
}
template <>
hid_t file_type<std::uint8_t>() {
  return H5T_STD_U8LE;
}

template <class T>
hid_t memory_type();
template <>
hid_t memory_type<double>() {
  return H5T_NATIVE_DOUBLE;
}
template <>
hid_t memory_type<std::int32_t>() {
  return H5T_NATIVE_INT32;
}
template <>
hid_t memory_type<std::int64_t>() {
  return H5T_NATIVE_INT64;
}
template <>
hid_t memory_type<std::uint64_t>() {
  return H5T_NATIVE_UINT64;
}
template <>
hid_t memory_type<std::uint8_t>() {
  return H5T_NATIVE_UINT8;
}

Handle properties(hid_t list_class) { return {H5Pcreate(list_class), H5Pclose, "", "out of HDF5 property lists"}; }

constexpr unsigned kCompact = 64;  // links and attributes of a group that stay in its header

// No time stamps, and everything small in the header, so that equal content means equal bytes.
void make_stable(hid_t group_properties) {
  H5Pset_obj_track_times(group_properties, false);
  H5Pset_attr_phase_change(group_properties, kCompact, 0);
}
void make_stable_group(hid_t group_properties) {
  make_stable(group_properties);
  H5Pset_link_phase_change(group_properties, kCompact, 0);
}

Handle memory_driver() {
  Handle access = properties(H5P_FILE_ACCESS);
  constexpr std::size_t kGrowth = std::size_t{1} << 20;  // [bytes] the image grows in such steps
  H5Pset_fapl_core(access, kGrowth, false);
  // H5Fget_file_image spoils the checksum of a version 2 superblock (status flag cleared, checksum kept; HDF5 1.10.8);
  // the earliest one has none.
  H5Pset_libver_bounds(access, H5F_LIBVER_EARLIEST, H5F_LIBVER_V18);
  return access;
}

Handle space(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose, "", "out of HDF5 data spaces"};
  const std::vector<hsize_t> dims(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr), H5Sclose, "", "bad shape"};
}

Handle text_type(std::size_t length) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "", "out of HDF5 types");
  H5Tset_size(type, std::max<std::size_t>(length, 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

Shape shape_of(hid_t data_space, const std::string& path) {
  const int rank = H5Sget_simple_extent_ndims(data_space);
  if (rank < 0 || H5Sget_simple_extent_type(data_space) == H5S_NULL) throw Hdf5Error(path, "has no shape");
  std::vector<hsize_t> dims(static_cast<std::size_t>(rank));
  if (rank > 0) require(H5Sget_simple_extent_dims(data_space, dims.data(), nullptr), path, "has no shape");
  return {dims.begin(), dims.end()};
}

std::string in_words(const Shape& shape) {
  std::string words;
  for (const std::size_t n : shape) words += (words.empty() ? "" : " x ") + std::to_string(n);
  return shape.empty() ? "a scalar" : words;
}

std::size_t count_of(const Shape& shape) {
  std::size_t count = 1;
  for (const std::size_t n : shape) count *= n;
  return count;
}

}  // namespace

struct Hdf5Writer::File {
  std::unique_lock<std::mutex> lock{library_lock()};
  Handle file;
  std::size_t user_block = 0;

  Handle open(const std::string& path) const {
    return {H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose, path, "cannot be opened"};
  }
  Handle attribute(const std::string& object, const std::string& name, hid_t type, hid_t data_space) const {
    const Handle owner = open(object);
    return {H5Acreate2(owner, name.c_str(), type, data_space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose, object + "@" + name,
            "cannot be created"};
  }
  Handle dataset(const std::string& path, hid_t type, hid_t data_space) const {
    Handle create = properties(H5P_DATASET_CREATE);
    make_stable(create);
    H5Pset_fill_time(create, H5D_FILL_TIME_NEVER);
    return {H5Dcreate2(file, path.c_str(), type, data_space, H5P_DEFAULT, create, H5P_DEFAULT), H5Dclose, path,
            "cannot be created"};
  }
};

Hdf5Writer::Hdf5Writer(std::size_t user_block) : file_(std::make_unique<File>()) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Handle access = memory_driver();
  const Handle create = properties(H5P_FILE_CREATE);
  make_stable_group(create);
  file_->user_block = user_block;
  file_->file = Handle(H5Fcreate("image", H5F_ACC_TRUNC, create, access), H5Fclose, "", "cannot create an HDF5 image");
}

Hdf5Writer::~Hdf5Writer() {
  if (file_) file_->file = Handle();  // before the lock goes
}

void Hdf5Writer::group(const std::string& path) {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string head = path.substr(0, end);
    if (!head.empty() && head != "/" && H5Lexists(file_->file, head.c_str(), H5P_DEFAULT) <= 0) {
      const Handle create = properties(H5P_GROUP_CREATE);
      make_stable_group(create);
      const Handle made(H5Gcreate2(file_->file, head.c_str(), H5P_DEFAULT, create, H5P_DEFAULT), H5Gclose, head,
                        "cannot be created");
    }
    if (end == std::string::npos) return;
  }
}

template <class T>
void Hdf5Writer::array(const std::string& path, const Shape& shape, std::span<const T> values, std::string_view unit) {
  if (values.size() != count_of(shape)) throw Hdf5Error(path, "values and shape differ");
  group(path.substr(0, path.rfind('/')));
  {
    const Handle data_space = space(shape);
    const Handle set = file_->dataset(path, file_type<T>(), data_space);
    if (!values.empty())
      require(H5Dwrite(set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path, "cannot be written");
  }
  if (!unit.empty()) attribute(path, "unit", unit);
}

void Hdf5Writer::text(const std::string& path, std::string_view value) {
  group(path.substr(0, path.rfind('/')));
  const Handle type = text_type(value.size());
  const Handle data_space = space({});
  const Handle set = file_->dataset(path, type, data_space);
  const std::string bytes = value.empty() ? std::string(1, '\0') : std::string(value);
  require(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, bytes.data()), path, "cannot be written");
}

template <class T>
void Hdf5Writer::attribute(const std::string& object, const std::string& name, T value) {
  const Handle data_space = space({});
  const Handle made = file_->attribute(object, name, file_type<T>(), data_space);
  require(H5Awrite(made, memory_type<T>(), &value), object + "@" + name, "cannot be written");
}

template <class T>
void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::span<const T> values) {
  const Handle data_space = space({values.size()});
  const Handle made = file_->attribute(object, name, file_type<T>(), data_space);
  require(H5Awrite(made, memory_type<T>(), values.data()), object + "@" + name, "cannot be written");
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, std::string_view value) {
  const Handle type = text_type(value.size());
  const Handle data_space = space({});
  const Handle made = file_->attribute(object, name, type, data_space);
  const std::string bytes = value.empty() ? std::string(1, '\0') : std::string(value);
  require(H5Awrite(made, type, bytes.data()), object + "@" + name, "cannot be written");
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, const std::vector<std::string>& values) {
  std::size_t length = 1;
  for (const std::string& value : values) length = std::max(length, value.size());
  std::string bytes;
  for (std::string value : values) {
    value.resize(length, '\0');
    bytes += value;
  }
  const Handle type = text_type(length);
  const Handle data_space = space({values.size()});
  const Handle made = file_->attribute(object, name, type, data_space);
  require(H5Awrite(made, type, bytes.data()), object + "@" + name, "cannot be written");
}

std::string Hdf5Writer::finish() {
  require(H5Fflush(file_->file, H5F_SCOPE_GLOBAL), "", "cannot flush the HDF5 image");
  const ssize_t size = H5Fget_file_image(file_->file, nullptr, 0);
  if (size < 0) throw Hdf5Error("", "cannot get the HDF5 image");
  // The library leaves the user block out of the image.
  const std::size_t front = file_->user_block, data = static_cast<std::size_t>(size);
  std::string image(front + data, '\0');
  if (H5Fget_file_image(file_->file, image.data() + front, data) != size)
    throw Hdf5Error("", "cannot get the HDF5 image");
  file_->file = Handle();
  return image;
}

struct Hdf5Reader::File {
  std::unique_lock<std::mutex> lock{library_lock()};
  Handle file;
  std::size_t bytes = 0;  // of the image

  Handle dataset(const std::string& path) const {
    // H5Lexists fails if a group on the way is missing, which is as good as "not there".
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
      if (H5Lexists(file, path.substr(0, end).c_str(), H5P_DEFAULT) <= 0) throw Hdf5Error(path, "is missing");
      if (end == std::string::npos) break;
    }
    return {H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, path, "is not a dataset"};
  }
  Handle attribute(const std::string& object, const std::string& name) const {
    const std::string path = object + "@" + name;
    if (H5Aexists_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT) <= 0) throw Hdf5Error(path, "is missing");
    return {H5Aopen_by_name(file, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, path,
            "cannot be opened"};
  }
  // A damaged header must not make us ask for more memory than the data can fill.
  void limit(const Shape& shape, std::size_t element, const std::string& path) const {
    constexpr double kMostCompressed = 1100;  // deflate gains at most a factor 1032
    double size = static_cast<double>(element);
    for (const std::size_t n : shape) size *= static_cast<double>(n);
    if (size > kMostCompressed * static_cast<double>(bytes)) throw Hdf5Error(path, "is larger than the file can hold");
  }
  void check_type(hid_t type, hid_t expected, const std::string& path) const {
    if (H5Tequal(type, expected) <= 0) throw Hdf5Error(path, "has another type than the format says");
  }
  static void check_shape(const Shape& shape, const Shape& expected, const std::string& path) {
    if (shape != expected)
      throw Hdf5Error(path, "has the shape " + in_words(shape) + ", expected " + in_words(expected));
  }
  std::size_t text_length(hid_t type, const std::string& path) const {
    if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0)
      throw Hdf5Error(path, "is not a text of fixed length");
    const std::size_t length = H5Tget_size(type);
    limit({length}, 1, path);
    return length;
  }
  std::vector<std::string> texts(const std::string& object, const std::string& name, const Shape& shape) const {
    const std::string path = object + "@" + name;
    const Handle made = attribute(object, name);
    const Handle type(H5Aget_type(made), H5Tclose, path, "has no type");
    const Handle data_space(H5Aget_space(made), H5Sclose, path, "has no shape");
    check_shape(shape_of(data_space, path), shape, path);
    const std::size_t length = text_length(type, path);
    std::string packed(length * count_of(shape), '\0');
    require(H5Aread(made, type, packed.data()), path, "cannot be read");
    std::vector<std::string> values;
    for (std::size_t at = 0; at < packed.size(); at += length) {
      values.push_back(packed.substr(at, length));
      values.back().resize(values.back().find_last_not_of('\0') + 1);
    }
    return values;
  }
};

Hdf5Reader::Hdf5Reader(std::string_view image) : file_(std::make_unique<File>()) {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  const Handle access = memory_driver();
  file_->bytes = image.size();
  if (image.empty()) throw Hdf5Error("", "is not an HDF5 file");
  require(H5Pset_file_image(access, const_cast<char*>(image.data()), image.size()), "", "does not fit into memory");
  file_->file = Handle(H5Fopen("image", H5F_ACC_RDONLY, access), H5Fclose, "", "is not an HDF5 file, or a damaged one");
}

Hdf5Reader::~Hdf5Reader() { file_->file = Handle(); }

Shape Hdf5Reader::shape(const std::string& path) const {
  const Handle set = file_->dataset(path);
  const Handle data_space(H5Dget_space(set), H5Sclose, path, "has no shape");
  return shape_of(data_space, path);
}

template <class T>
std::vector<T> Hdf5Reader::array(const std::string& path, const Shape& shape) const {
  const Handle set = file_->dataset(path);
  const Handle type(H5Dget_type(set), H5Tclose, path, "has no type");
  file_->check_type(type, file_type<T>(), path);
  const Handle data_space(H5Dget_space(set), H5Sclose, path, "has no shape");
  File::check_shape(shape_of(data_space, path), shape, path);
  file_->limit(shape, sizeof(T), path);
  std::vector<T> values(count_of(shape));
  if (!values.empty())
    require(H5Dread(set, memory_type<T>(), H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), path, "cannot be read");
  return values;
}

std::string Hdf5Reader::text(const std::string& path) const {
  const Handle set = file_->dataset(path);
  const Handle type(H5Dget_type(set), H5Tclose, path, "has no type");
  const Handle data_space(H5Dget_space(set), H5Sclose, path, "has no shape");
  File::check_shape(shape_of(data_space, path), {}, path);
  std::string value(file_->text_length(type, path), '\0');
  require(H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()), path, "cannot be read");
  value.resize(value.find_last_not_of('\0') + 1);
  return value;
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
  return H5Aexists_by_name(file_->file, object.c_str(), name.c_str(), H5P_DEFAULT) > 0;
}

template <class T>
T Hdf5Reader::attribute(const std::string& object, const std::string& name) const {
  const std::string path = object + "@" + name;
  const Handle made = file_->attribute(object, name);
  const Handle type(H5Aget_type(made), H5Tclose, path, "has no type");
  file_->check_type(type, file_type<T>(), path);
  const Handle data_space(H5Aget_space(made), H5Sclose, path, "has no shape");
  File::check_shape(shape_of(data_space, path), {}, path);
  T value{};
  require(H5Aread(made, memory_type<T>(), &value), path, "cannot be read");
  return value;
}

template <class T>
std::vector<T> Hdf5Reader::attributes(const std::string& object, const std::string& name, std::size_t count) const {
  const std::string path = object + "@" + name;
  const Handle made = file_->attribute(object, name);
  const Handle type(H5Aget_type(made), H5Tclose, path, "has no type");
  file_->check_type(type, file_type<T>(), path);
  const Handle data_space(H5Aget_space(made), H5Sclose, path, "has no shape");
  File::check_shape(shape_of(data_space, path), {count}, path);
  std::vector<T> values(count);
  require(H5Aread(made, memory_type<T>(), values.data()), path, "cannot be read");
  return values;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
  return file_->texts(object, name, {}).front();
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name, std::size_t count) const {
  const std::vector<std::string> texts = file_->texts(object, name, {count});
  for (const std::string& text : texts)
    if (text != texts.front()) return {};
  return texts.empty() ? std::string{} : texts.front();
}

template void Hdf5Writer::array(const std::string&, const Shape&, std::span<const double>, std::string_view);
template void Hdf5Writer::array(const std::string&, const Shape&, std::span<const std::int32_t>, std::string_view);
template void Hdf5Writer::array(const std::string&, const Shape&, std::span<const std::int64_t>, std::string_view);
template void Hdf5Writer::array(const std::string&, const Shape&, std::span<const std::uint8_t>, std::string_view);
template void Hdf5Writer::attribute(const std::string&, const std::string&, double);
template void Hdf5Writer::attribute(const std::string&, const std::string&, std::int64_t);
template void Hdf5Writer::attribute(const std::string&, const std::string&, std::uint64_t);
template void Hdf5Writer::attribute(const std::string&, const std::string&, std::span<const double>);
template void Hdf5Writer::attribute(const std::string&, const std::string&, std::span<const std::int64_t>);
template std::vector<double> Hdf5Reader::array(const std::string&, const Shape&) const;
template std::vector<std::int32_t> Hdf5Reader::array(const std::string&, const Shape&) const;
template std::vector<std::int64_t> Hdf5Reader::array(const std::string&, const Shape&) const;
template std::vector<std::uint8_t> Hdf5Reader::array(const std::string&, const Shape&) const;
template double Hdf5Reader::attribute(const std::string&, const std::string&) const;
template std::int64_t Hdf5Reader::attribute(const std::string&, const std::string&) const;
template std::uint64_t Hdf5Reader::attribute(const std::string&, const std::string&) const;
template std::vector<double> Hdf5Reader::attributes(const std::string&, const std::string&, std::size_t) const;

}  // namespace isostat
