// State files: everything comes back, the same state gives the same bytes, and whatever is wrong with a file is one
// InputError.
#include "dem/files/state_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hdf5.h>
#include <rapidcheck/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <sstream>

#include "dem/disks/physical_hash.hpp"
#include "dem/disks/state_check.hpp"
#include "dem/files/atomic_file.hpp"
#include "dem/files/state_seal.hpp"
#include "dem/input_error.hpp"
#include "tests/support/random_state.hpp"
#include "tests/support/skip.hpp"
#include "tests/support/temporary_folder.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

RC_GTEST_PROP(StateFile, EverythingComesBack, (std::uint64_t seed)) {
  const State<Disks> state = random_state(seed, *rc::gen::inRange(0, 12), *rc::gen::inRange(0, 20));
  const std::string image = encode_state(state, {"1.2.3", "", "pack scene.toml"});
  const StateFile back = decode_state(image, "memory");
  expect_equal(state, std::get<State<Disks>>(back.state));
  RC_ASSERT(!::testing::Test::HasFailure());
  RC_ASSERT(back.provenance.version == "1.2.3");
  RC_ASSERT(back.provenance.command == "pack scene.toml");
  RC_ASSERT(!back.provenance.compiler.empty());
  RC_ASSERT(back.hash == physical_hash(state));
  RC_ASSERT(encode_state(back.state, back.provenance) == image);
}

// Files of format version 3, one of each scene shipped then, as the isostat of that time wrote them: they open, which
// compares the stored hash, and come back from being written again.
TEST(StateFile, FilesOfFormat3AreRead) {
  int files = 0;
  for (const auto& entry : fs::directory_iterator(std::string(ISOSTAT_DATA) + "/../tests/golden/format3")) {
    SCOPED_TRACE(entry.path().filename().string());
    const StateFile file = read_state_file(entry.path().string());
    EXPECT_GT(std::get<State<Disks>>(file.state).step, 1000);
    EXPECT_EQ(std::get<State<Disks>>(file.state).surroundings, Surroundings{});
    const StateFile again = decode_state(encode_state(file.state, file.provenance), "memory");
    EXPECT_EQ(again.hash, file.hash);
    expect_equal(std::get<State<Disks>>(again.state), std::get<State<Disks>>(file.state));
    ++files;
  }
  EXPECT_EQ(files, 7);
}

// Of disks in a hopper and of triangles between smooth walls.
TEST(StateFile, FilesOfFormat4AreRead) {
  const std::string folder = std::string(ISOSTAT_DATA) + "/../tests/golden/format4/";
  const auto again = [&](const char* name) {
    const StateFile file = read_state_file(folder + name);
    EXPECT_EQ(decode_state(encode_state(file.state, file.provenance), "memory").hash, file.hash);
    return file.state;
  };
  const AnyState hopper = again("disks-hopper.h5"), box = again("triangles-box.h5");
  const auto& disks = std::get<State<Disks>>(hopper);
  EXPECT_TRUE(disks.surroundings.open);
  EXPECT_FALSE(disks.memory.wall_position.empty());
  EXPECT_TRUE(disks.packing.feet.empty());
  EXPECT_EQ(disks.ledger.wall_work, 0);
  EXPECT_FALSE(std::get<State<TriangleGrains>>(box).packing.overlaps.empty());
}

TEST(StateFile, SameStateSameBytesOnDisk) {
  const TemporaryFolder folder;
  const State<Disks> state = random_state(3, 50, 90);
  write_state(state, folder / "a.h5");
  write_state(state, folder / "b.h5");
  EXPECT_EQ(read_whole_file(folder / "a.h5"), read_whole_file(folder / "b.h5"));
  expect_equal(read_state<Disks>(folder / "a.h5"), state);
  EXPECT_TRUE(is_state_file(folder / "a.h5"));
  EXPECT_EQ(folder.entries(), 2u);
}

TEST(StateFile, EveryTruncationIsBadInput) {
  const std::string image = encode_state(random_state(5, 20, 30));
  for (std::size_t size = 0; size < image.size(); size += size < 2 * kSealBytes ? 1 : 61)
    EXPECT_THROW(decode_state(std::string_view(image).substr(0, size), "cut"), InputError) << size;
  EXPECT_THAT(message_of([&] { decode_state(std::string_view(image).substr(0, 5000), "cut"); }),
              HasSubstr("truncated"));
  EXPECT_THROW(decode_state(image + "x", "longer"), InputError);
  const std::string seal_of_nothing = image.substr(0, image.find("bytes ")) + "bytes 0\n";
  EXPECT_THROW(decode_state(seal_of_nothing, "short"), InputError);  // not even a whole seal
}

TEST(StateFile, EveryFlippedBitIsBadInput) {
  std::string image = encode_state(random_state(6, 20, 30));
  const auto flip = [&](std::size_t byte, int bit) { image[byte] = static_cast<char>(image[byte] ^ (1 << bit)); };
  for (std::size_t byte = 0; byte < image.size(); byte += byte < kSealBytes ? 1 : 37) {
    const int bit = static_cast<int>(byte % 8);
    flip(byte, bit);
    EXPECT_THROW(decode_state(image, "flipped"), InputError) << byte;
    flip(byte, bit);
  }
  EXPECT_NO_THROW(decode_state(image, "whole"));
}

TEST(StateFile, OtherFilesAreBadInput) {
  const TemporaryFolder folder;
  EXPECT_THAT(message_of([&] { read_state<Disks>(folder / "none.h5"); }), HasSubstr("No such file"));
  EXPECT_THAT(message_of([&] { read_state<Disks>("/tmp"); }), HasSubstr("directory"));
  std::ofstream(folder / "text.h5") << "hello";
  EXPECT_THAT(message_of([&] { read_state<Disks>(folder / "text.h5"); }), HasSubstr("not a state file"));
  EXPECT_FALSE(is_state_file(folder / "text.h5") || is_state_file(folder / "none.h5") || is_state_file("/tmp"));
  std::string later = encode_state(random_state(1, 2, 1));
  later.replace(later.find("version 7"), 9, "version 8");
  EXPECT_THAT(message_of([&] { decode_state(later, "later.h5"); }), HasSubstr("format_version = 8"));
}

// The image after changes by the HDF5 library itself, sealed anew: what only the inner checks can find.
std::string edited(const State<Disks>& state, const std::function<void(hid_t)>& edit) {
  std::string image = encode_state(state);
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, 1 << 16, false);
  H5Pset_file_image(access, image.data(), image.size());
  const hid_t file = H5Fopen("edited", H5F_ACC_RDWR, access);
  EXPECT_GE(file, 0);
  edit(file);
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  const auto size = static_cast<std::size_t>(H5Fget_file_image(file, nullptr, 0));
  image.assign(kSealBytes + size, '\0');
  H5Fget_file_image(file, image.data() + kSealBytes, size);
  H5Fclose(file);
  H5Pclose(access);
  seal_state(image);
  return image;
}

template <class T>
void overwrite(hid_t file, const char* path, hid_t type, std::size_t element, T value) {
  const hid_t set = H5Dopen2(file, path, H5P_DEFAULT);
  const hid_t space = H5Dget_space(set);
  std::vector<T> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  values.at(element) = value;
  EXPECT_GE(H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()), 0);
  H5Sclose(space), H5Dclose(set);
}

void replace_array(hid_t file, const char* path, hid_t type, std::vector<hsize_t> dims) {
  H5Ldelete(file, path, H5P_DEFAULT);
  const hid_t space = H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
  const hid_t set = H5Dcreate2(file, path, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(set, 0);
  H5Dclose(set), H5Sclose(space);
}

template <class T>
void set_attribute(hid_t file, const char* object, const char* name, hid_t type, T value) {
  const hid_t owner = H5Oopen(file, object, H5P_DEFAULT);
  const hid_t attribute = H5Aopen(owner, name, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, type, &value), 0);
  H5Aclose(attribute), H5Oclose(owner);
}

// Of the file itself.
void set_text(hid_t file, const char* name, const std::string& text) {
  H5Adelete(file, name);
  const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
  H5Tset_size(type, text.size()), H5Tset_cset(type, H5T_CSET_UTF8);
  const hid_t attribute = H5Acreate2(file, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  EXPECT_GE(H5Awrite(attribute, type, text.data()), 0);
  H5Aclose(attribute), H5Sclose(space), H5Tclose(type);
}

struct InnerFault {
  const char* expected;  // in the message
  std::function<void(hid_t)> edit;
};

TEST(StateFile, EveryInnerFaultIsNamed) {
  const State<Disks> state = random_state(8, 10, 15);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(decode_state(edited(state, [](hid_t) {}), "untouched"));
  const std::vector<InnerFault> faults{
      {"/particles/grains/radius: is missing", [](hid_t f) { H5Ldelete(f, "/particles/grains/radius", H5P_DEFAULT); }},
      {"/particles/grains/id: is missing", [](hid_t f) { H5Ldelete(f, "/particles", H5P_DEFAULT); }},
      {"/law@friction: is missing", [](hid_t f) { H5Adelete_by_name(f, "/law", "friction", H5P_DEFAULT); }},
      {"/scene: is missing", [](hid_t f) { H5Ldelete(f, "/scene", H5P_DEFAULT); }},
      {"/links/gap: has the shape 3, expected 15",
       [](hid_t f) { replace_array(f, "/links/gap", H5T_IEEE_F64LE, {3}); }},
      {"/particles/grains/position/value: has the shape 1 x 10 x 3",
       [](hid_t f) {
         replace_array(f, "/particles/grains/position/value", H5T_IEEE_F64LE, {1, 10, 3});
       }},
      {"/links/gap: has another type", [](hid_t f) { replace_array(f, "/links/gap", H5T_IEEE_F32LE, {15}); }},
      {"/particles/grains/id: is a scalar, expected an array",
       [](hid_t f) {
         H5Ldelete(f, "/particles/grains/id", H5P_DEFAULT);
         const hid_t space = H5Screate(H5S_SCALAR);
         H5Dclose(H5Dcreate2(f, "/particles/grains/id", H5T_STD_I64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
         H5Sclose(space);
       }},
      {"particles/grains/position: element 3 is not a finite number",
       [=](hid_t f) { overwrite(f, "/particles/grains/position/value", H5T_NATIVE_DOUBLE, 7, nan); }},
      {"particles/grains/radius: element 2 is not positive",
       [](hid_t f) { overwrite(f, "/particles/grains/radius", H5T_NATIVE_DOUBLE, 2, -1.0); }},
      {"box/edges: an edge is not positive",
       [](hid_t f) { overwrite(f, "/particles/grains/box/edges/value", H5T_NATIVE_DOUBLE, 1, 0.0); }},
      {"links/i: link 4 does not join two grains",
       [](hid_t f) { overwrite<std::int32_t>(f, "/links/i", H5T_NATIVE_INT32, 4, 10); }},
      {"links/i: link 0 does not join two grains",
       [](hid_t f) { overwrite<std::int32_t>(f, "/links/j", H5T_NATIVE_INT32, 0, -1); }},
      {"links/kind: link 5 has an unknown kind",
       [](hid_t f) { overwrite<std::uint8_t>(f, "/links/kind", H5T_NATIVE_UINT8, 5, 9); }},
      {"links: link 6 has a gap, force or moment that is not a finite number",
       [=](hid_t f) { overwrite(f, "/links/normal_force", H5T_NATIVE_DOUBLE, 6, nan); }},
      {"solver/pairs: a pair does not join",
       [](hid_t f) { overwrite<std::int32_t>(f, "/solver/pairs/i", H5T_NATIVE_INT32, 1, 99); }},
      {"/@system: is missing", [](hid_t f) { H5Adelete(f, "system"); }},
      {"/particles/triangles/id: is missing", [](hid_t f) { set_text(f, "system", "triangles"); }},
      {"/@system = squares: this isostat knows disks, triangles and spheres",
       [](hid_t f) { set_text(f, "system", "squares"); }},
      {"/surroundings@open: is missing", [](hid_t f) { H5Adelete_by_name(f, "/surroundings", "open", H5P_DEFAULT); }},
      {"format_version = 8",
       [](hid_t f) { set_attribute<std::int64_t>(f, "/", "format_version", H5T_NATIVE_INT64, 8); }},
      {"law: a parameter that is negative",
       [](hid_t f) { set_attribute(f, "/law", "friction", H5T_NATIVE_DOUBLE, -0.5); }},
      {"/progress@started: is out of range",
       [](hid_t f) { set_attribute<std::int64_t>(f, "/progress", "started", H5T_NATIVE_INT64, 2); }},
      {"progress: stage is not one of the scene's",
       [](hid_t f) { set_attribute<std::int64_t>(f, "/progress", "stage", H5T_NATIVE_INT64, 99); }},
      {"hash", [](hid_t f) { overwrite(f, "/particles/grains/spin/value", H5T_NATIVE_DOUBLE, 0, 0.125); }},
  };
  for (const InnerFault& fault : faults)
    EXPECT_THAT(message_of([&] { decode_state(edited(state, fault.edit), "edited.h5"); }), HasSubstr(fault.expected));
}

TEST(StateFile, ImpossibleStatesAreNotWritten) {
  const TemporaryFolder folder;
  State<Disks> state = random_state(9, 5, 4);
  state.packing.bodies.velocity[2][1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(write_state(state, folder / "state.h5"), std::invalid_argument);
  EXPECT_EQ(folder.entries(), 0u);
  state = random_state(9, 5, 4);
  state.packing.bodies.id[0] = state.packing.bodies.id[1];
  EXPECT_EQ(state_fault(state)->field, "particles/grains/id");
}

TEST(StateFile, FailedWriteLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder folder;
  const State<Disks> old = random_state(10, 5, 4);
  write_state(old, folder / "state.h5");
  rlimit before{};
  ::getrlimit(RLIMIT_FSIZE, &before);
  const auto handler = ::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  ::setrlimit(RLIMIT_FSIZE, &small);
  const std::string message = message_of([&] { write_state(random_state(11, 50, 40), folder / "state.h5"); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  ::signal(SIGXFSZ, handler);
  EXPECT_THAT(message, HasSubstr("cannot be written: File too large"));
  EXPECT_EQ(folder.entries(), 1u);
  expect_equal(read_state<Disks>(folder / "state.h5"), old);
}

TEST(StateFile, UnwritablePathsAreBadInput) {
  const TemporaryFolder folder;
  const State<Disks> state = random_state(12, 3, 2);
  for (const std::string& path : {folder / "no/such/state.h5", std::string("/tmp"), std::string()}) {
    EXPECT_THROW(write_state(state, path), InputError) << path;
    EXPECT_THROW(require_writable(path), InputError) << path;
  }
  EXPECT_THAT(message_of([&] { write_state(state, "/dev/full"); }), HasSubstr("No space left on device"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
  EXPECT_NO_THROW(require_writable(folder / "state.h5"));
  EXPECT_EQ(folder.entries(), 0u);
  write_state(state, folder / "real.h5");
  fs::create_symlink(folder / "real.h5", folder / "link.h5");
  write_state(random_state(13, 3, 2), folder / "link.h5");
  EXPECT_TRUE(fs::is_symlink(folder / "link.h5"));
  expect_equal(read_state<Disks>(folder / "real.h5"), random_state(13, 3, 2));
}

// The reader printed in docs/formats.md, run as it stands.
TEST(StateFile, IsReadByTheTenLinesOfTheDocumentation) {
  if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0) ISOSTAT_SKIP("no /usr/bin/python3 with h5py");
  std::ifstream page(std::filesystem::path(ISOSTAT_DATA).parent_path() / "docs/formats.md");
  std::ostringstream text;
  text << page.rdbuf();
  const std::string fence = "```python\n", all = text.str();
  const std::size_t begin = all.find(fence) + fence.size();
  const TemporaryFolder folder;
  State<Disks> state = random_state(21, 4, 3);
  for (Link<2>& l : state.packing.links) {
    const Bodies<2>& b = state.packing.bodies;
    const auto i = static_cast<std::size_t>(l.i), j = static_cast<std::size_t>(l.j);
    l.gap = norm(b.position[j] + state.packing.cell->offset(l.shift) - b.position[i]) - b.radius[i] - b.radius[j];
  }
  write_state(state, folder / "state.h5");
  std::ofstream(folder / "read.py") << all.substr(begin, all.find("```", begin) - begin);
  const std::string command = "cd " + (folder / "") + " && /usr/bin/python3 read.py > out.txt 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_THAT(read_whole_file(folder / "out.txt"), HasSubstr(physical_hash(state)));
  EXPECT_THAT(read_whole_file(folder / "out.txt"), HasSubstr(" 4 3 True"));
}

}  // namespace
}  // namespace isostat
