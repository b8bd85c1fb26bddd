// HDF5 files as images in memory: the one owner of the HDF5 C library, whose types stay in the .cpp file. Images are
// byte-stable: no time stamps, fixed library version bounds, little-endian types, contiguous arrays.
//
// The library is not thread safe; each object holds a global lock while it lives.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace isostat {

using Shape = std::vector<std::size_t>;

// Something about an object of the image: missing, of another type, of another shape, or not HDF5 at all.
struct Hdf5Error : std::runtime_error {
  Hdf5Error(std::string object_path, const std::string& reason)
      : std::runtime_error(reason), path(std::move(object_path)) {}
  std::string path;
};

// T: double, std::int32_t, std::int64_t, std::uint64_t, std::uint8_t.
class Hdf5Writer {
 public:
  explicit Hdf5Writer(std::size_t user_block);  // bytes left free at the front: 0, or a power of two from 512 on
  ~Hdf5Writer();

  // Groups on the way are created.
  void group(const std::string& path);
  template <class T>
  void array(const std::string& path, const Shape& shape, std::span<const T> values, std::string_view unit = {});
  void text(const std::string& path, std::string_view value);  // scalar, fixed length, UTF-8
  template <class T>
  void attribute(const std::string& object, const std::string& name, T value);
  template <class T>
  void attribute(const std::string& object, const std::string& name, std::span<const T> values);
  void attribute(const std::string& object, const std::string& name, std::string_view value);
  void attribute(const std::string& object, const std::string& name, const std::vector<std::string>& values);

  std::string finish();  // the image; the writer is done

 private:
  struct File;
  std::unique_ptr<File> file_;
};

class Hdf5Reader {
 public:
  explicit Hdf5Reader(std::string_view image);  // throws Hdf5Error if it is not HDF5
  ~Hdf5Reader();

  Shape shape(const std::string& path) const;
  // Throws unless the object is there with exactly this type and shape.
  template <class T>
  std::vector<T> array(const std::string& path, const Shape& shape) const;
  std::string text(const std::string& path) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  template <class T>
  T attribute(const std::string& object, const std::string& name) const;
  template <class T>
  std::vector<T> attributes(const std::string& object, const std::string& name, std::size_t count) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  // A list of equal texts: their common value; empty if they differ.
  std::string text_attribute(const std::string& object, const std::string& name, std::size_t count) const;

 private:
  struct File;
  std::unique_ptr<File> file_;
};

}  // namespace isostat
