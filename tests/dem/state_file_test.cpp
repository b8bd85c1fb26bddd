// State files: everything comes back, the same state gives the same bytes, and whatever is wrong with a file is one
// InputError.
#include "dem/state_file.hpp"

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
#include <numeric>
#include <random>
#include <sstream>

#include "dem/atomic_file.hpp"
#include "dem/input_error.hpp"
#include "dem/physical_hash.hpp"
#include "dem/state_check.hpp"
#include "dem/state_seal.hpp"

namespace isostat {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  double real() { return std::uniform_real_distribution<>(-3, 3)(engine_); }
  double positive() { return std::uniform_real_distribution<>(0.1, 3)(engine_); }
  int integer(int low, int high) { return std::uniform_int_distribution<>(low, high)(engine_); }
  bool coin() { return integer(0, 1) == 1; }
  Vec2 vec() {
    const double x = real();
    return {{x, real()}};
  }
  std::uint64_t word() { return engine_(); }
  std::mt19937_64& engine() { return engine_; }

 private:
  std::mt19937_64 engine_;
};

// Every member set to something; no physics in it.
State random_state(std::uint64_t seed, int grains, int links) {
  Draw d(seed);
  State s;
  if (d.coin() || links > 0) s.packing.cell = PeriodicCell<2>{{{d.positive(), d.positive()}}};
  Bodies<2>& b = s.packing.bodies;
  for (int k = 0; k < grains; ++k) {
    b.id.push_back(7 * k - 20);
    b.position.push_back(d.vec()), b.velocity.push_back(d.vec()), b.spin.push_back(d.real());
    b.radius.push_back(d.positive()), b.mass.push_back(d.positive()), b.inertia.push_back(d.positive());
  }
  std::shuffle(b.id.begin(), b.id.end(), d.engine());
  for (int k = 0; k < links && grains > 0; ++k) {
    Link<2> l;
    l.i = d.integer(0, grains - 1), l.j = d.integer(0, grains - 1);
    l.shift = {d.integer(-1, 1), l.i == l.j ? 1 : d.integer(-1, 1)};
    l.kind = static_cast<LinkKind>(d.integer(0, 4));
    l.gap = d.real(), l.normal_force = d.real(), l.tangential_force = d.real(), l.moment = d.real();
    s.packing.links.push_back(l);
    s.memory.pairs.push_back({l.i, l.j, l.shift, d.real(), d.real()});
  }
  auto& law = s.law;
  for (double* x : {&law.normal_stiffness, &law.tangential_stiffness, &law.damping, &law.friction,
                    &law.rolling_friction, &law.rolling_stiffness, &law.attraction, &law.attraction_range})
    *x = d.positive();
  s.time = d.positive(), s.step = d.integer(0, 1 << 30), s.time_step = d.positive();
  s.cell_motion = {d.vec(), d.vec(), d.vec()};
  for (auto& stress : s.imposed_stress)
    if (d.coin()) stress = d.real();
  if (d.coin())
    for (int k = 0; k < grains; ++k) {
      s.memory.half_velocity.push_back(d.vec()), s.memory.half_spin.push_back(d.real());
      s.memory.force.push_back(d.vec()), s.memory.torque.push_back(d.real());
      s.memory.outer_position.push_back(d.vec()), s.memory.inner_position.push_back(d.vec());
    }
  s.memory.outer_length = d.vec(), s.memory.inner_length = d.vec();
  s.memory.outer_skin = d.real(), s.memory.inner_skin = d.real();
  s.memory.outer_travel = d.real(), s.memory.inner_travel = d.real();
  s.scene.stages.resize(static_cast<std::size_t>(d.integer(0, 3)));
  for (StageScene& stage : s.scene.stages) stage.pressure = d.positive(), stage.velocity = d.positive();
  s.scene.law.friction = d.positive(), s.scene.output.series = "a \"quoted\"\nname";
  s.scene.seed = d.word() >> 1;
  s.progress = {d.integer(0, static_cast<int>(s.scene.stages.size())), d.real(), d.coin(), d.coin(), d.real()};
  s.ledger = {d.real(), d.real(), d.real(), d.real(), d.real(), d.real(), d.real(), d.real()};
  Certificate& c = s.certificate;
  for (double* x : {&c.max_force, &c.max_moment, &c.pressure_error, &c.kinetic_energy_per_grain, &c.force_scale,
                    &c.tolerance_force, &c.tolerance_pressure, &c.tolerance_kinetic, &c.smallest_margin})
    *x = d.real();
  c.sliding = d.integer(0, 99), c.rolling_yielded = d.integer(0, 99);
  c.pressure_controlled = d.coin(), c.equilibrated = d.coin();
  c.finishing = "drag";
  s.seed = d.word(), s.random_counter = d.word();
  return s;
}

template <class T>
std::vector<double> numbers(const T& x) {
  if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
    return {static_cast<double>(x)};
  } else if constexpr (requires { x.c; }) {
    return {x.c.begin(), x.c.end()};
  } else {
    std::vector<double> all;
    for (const auto& element : x)
      for (const double v : numbers(element)) all.push_back(v);
    return all;
  }
}

#define EXPECT_SAME(member) EXPECT_EQ(numbers(a.member), numbers(b.member)) << #member

void expect_equal(const State& a, const State& b) {
  ASSERT_EQ(a.packing.cell.has_value(), b.packing.cell.has_value());
  if (a.packing.cell) {
    EXPECT_SAME(packing.cell->length);
  }
  EXPECT_EQ(a.packing.bodies.id, b.packing.bodies.id);
  EXPECT_SAME(packing.bodies.position);
  EXPECT_SAME(packing.bodies.velocity);
  EXPECT_SAME(packing.bodies.spin);
  EXPECT_SAME(packing.bodies.radius);
  EXPECT_SAME(packing.bodies.mass);
  EXPECT_SAME(packing.bodies.inertia);
  ASSERT_EQ(a.packing.links.size(), b.packing.links.size());
  for (std::size_t k = 0; k < a.packing.links.size(); ++k) {
    const auto row = [k](const State& s) {
      const Link<2>& l = s.packing.links[k];
      return std::make_tuple(l.i, l.j, l.shift, l.kind, l.gap, l.normal_force, l.tangential_force, l.moment);
    };
    EXPECT_EQ(row(a), row(b));
  }
  ASSERT_EQ(a.memory.pairs.size(), b.memory.pairs.size());
  for (std::size_t k = 0; k < a.memory.pairs.size(); ++k) {
    const auto row = [k](const State& s) {
      const PairMemory& p = s.memory.pairs[k];
      return std::make_tuple(p.i, p.j, p.shift, p.tangential_force, p.moment);
    };
    EXPECT_EQ(row(a), row(b));
  }
  EXPECT_SAME(law.normal_stiffness);
  EXPECT_SAME(law.tangential_stiffness);
  EXPECT_SAME(law.damping);
  EXPECT_SAME(law.friction);
  EXPECT_SAME(law.rolling_friction);
  EXPECT_SAME(law.rolling_stiffness);
  EXPECT_SAME(law.attraction);
  EXPECT_SAME(law.attraction_range);
  EXPECT_SAME(time);
  EXPECT_EQ(a.step, b.step);
  EXPECT_SAME(time_step);
  EXPECT_SAME(cell_motion.reference_length);
  EXPECT_SAME(cell_motion.strain_rate);
  EXPECT_SAME(cell_motion.stress);
  EXPECT_EQ(a.imposed_stress, b.imposed_stress);
  EXPECT_SAME(memory.half_velocity);
  EXPECT_SAME(memory.half_spin);
  EXPECT_SAME(memory.force);
  EXPECT_SAME(memory.torque);
  EXPECT_SAME(memory.outer_position);
  EXPECT_SAME(memory.inner_position);
  EXPECT_SAME(memory.outer_length);
  EXPECT_SAME(memory.inner_length);
  EXPECT_SAME(memory.outer_skin);
  EXPECT_SAME(memory.inner_skin);
  EXPECT_SAME(memory.outer_travel);
  EXPECT_SAME(memory.inner_travel);
  EXPECT_SAME(progress.stage);
  EXPECT_SAME(progress.start_time);
  EXPECT_SAME(progress.started);
  EXPECT_SAME(progress.drag_on);
  EXPECT_SAME(progress.quiet_since);
  EXPECT_SAME(progress.contact_set);
  EXPECT_SAME(progress.unchanged_since);
  EXPECT_SAME(progress.start_stiffness);
  EXPECT_SAME(progress.start_stress);
  EXPECT_SAME(progress.peak_stress);
  EXPECT_SAME(ledger.viscous);
  EXPECT_SAME(ledger.sliding);
  EXPECT_SAME(ledger.rolling);
  EXPECT_SAME(ledger.drag);
  EXPECT_SAME(ledger.cell_work);
  EXPECT_SAME(ledger.injected);
  EXPECT_SAME(ledger.viscous_due);
  EXPECT_SAME(ledger.cell_work_due);
  EXPECT_SAME(certificate.max_force);
  EXPECT_SAME(certificate.max_moment);
  EXPECT_SAME(certificate.pressure_error);
  EXPECT_SAME(certificate.kinetic_energy_per_grain);
  EXPECT_SAME(certificate.force_scale);
  EXPECT_SAME(certificate.tolerance_force);
  EXPECT_SAME(certificate.tolerance_pressure);
  EXPECT_SAME(certificate.tolerance_kinetic);
  EXPECT_SAME(certificate.sliding);
  EXPECT_SAME(certificate.rolling_yielded);
  EXPECT_SAME(certificate.smallest_margin);
  EXPECT_SAME(certificate.pressure_controlled);
  EXPECT_SAME(certificate.equilibrated);
  EXPECT_EQ(a.certificate.finishing, b.certificate.finishing);
  EXPECT_EQ(a.scene, b.scene);
  EXPECT_EQ(a.seed, b.seed);
  EXPECT_EQ(a.random_counter, b.random_counter);
}

// A directory of this test's own, removed afterwards.
class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "isostat-XXXXXX").string();
    path_ = ::mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path_), fs::directory_iterator()));
  }

 private:
  fs::path path_;
};

std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

RC_GTEST_PROP(StateFile, EverythingComesBack, (std::uint64_t seed)) {
  const State state = random_state(seed, *rc::gen::inRange(0, 12), *rc::gen::inRange(0, 20));
  const std::string image = encode_state(state, {"1.2.3", "", "pack scene.toml"});
  const StateFile back = decode_state(image, "memory");
  expect_equal(state, back.state);
  RC_ASSERT(!::testing::Test::HasFailure());
  RC_ASSERT(back.provenance.version == "1.2.3");
  RC_ASSERT(back.provenance.command == "pack scene.toml");
  RC_ASSERT(!back.provenance.compiler.empty());
  RC_ASSERT(back.hash == physical_hash(state));
  RC_ASSERT(encode_state(back.state, back.provenance) == image);
}

TEST(StateFile, SameStateSameBytesOnDisk) {
  const Folder folder;
  const State state = random_state(3, 50, 90);
  write_state(state, folder / "a.h5");
  write_state(state, folder / "b.h5");
  EXPECT_EQ(read_whole_file(folder / "a.h5"), read_whole_file(folder / "b.h5"));
  expect_equal(read_state(folder / "a.h5"), state);
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
  const Folder folder;
  EXPECT_THAT(message_of([&] { read_state(folder / "none.h5"); }), HasSubstr("No such file"));
  EXPECT_THAT(message_of([&] { read_state("/tmp"); }), HasSubstr("directory"));
  std::ofstream(folder / "text.h5") << "hello";
  EXPECT_THAT(message_of([&] { read_state(folder / "text.h5"); }), HasSubstr("not a state file"));
  EXPECT_FALSE(is_state_file(folder / "text.h5") || is_state_file(folder / "none.h5") || is_state_file("/tmp"));
  std::string later = encode_state(random_state(1, 2, 1));
  later.replace(later.find("version 2"), 9, "version 3");
  EXPECT_THAT(message_of([&] { decode_state(later, "later.h5"); }), HasSubstr("format_version = 3"));
}

// The image after changes by the HDF5 library itself, sealed anew: what only the inner checks can find.
std::string edited(const State& state, const std::function<void(hid_t)>& edit) {
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

struct InnerFault {
  const char* expected;  // in the message
  std::function<void(hid_t)> edit;
};

TEST(StateFile, EveryInnerFaultIsNamed) {
  const State state = random_state(8, 10, 15);
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
      {"format_version = 7",
       [](hid_t f) { set_attribute<std::int64_t>(f, "/", "format_version", H5T_NATIVE_INT64, 7); }},
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
  const Folder folder;
  State state = random_state(9, 5, 4);
  state.packing.bodies.velocity[2][1] = std::numeric_limits<double>::infinity();
  EXPECT_THROW(write_state(state, folder / "state.h5"), std::invalid_argument);
  EXPECT_EQ(folder.entries(), 0u);
  state = random_state(9, 5, 4);
  state.packing.bodies.id[0] = state.packing.bodies.id[1];
  EXPECT_EQ(state_fault(state)->field, "particles/grains/id");
}

TEST(StateFile, FailedWriteLeavesTheOldFileAndNothingElse) {
  const Folder folder;
  const State old = random_state(10, 5, 4);
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
  expect_equal(read_state(folder / "state.h5"), old);
}

TEST(StateFile, UnwritablePathsAreBadInput) {
  const Folder folder;
  const State state = random_state(12, 3, 2);
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
  expect_equal(read_state(folder / "real.h5"), random_state(13, 3, 2));
}

// The same packing in another order of storage, every other link seen from its other end.
State shuffled(const State& state, std::uint64_t seed) {
  State s = state;
  const std::size_t n = state.packing.bodies.size();
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::mt19937_64 engine(seed);
  std::shuffle(order.begin(), order.end(), engine);
  std::vector<std::int32_t> place(n);
  const Bodies<2>& from = state.packing.bodies;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t o = order[k];
    Bodies<2>& to = s.packing.bodies;
    place[o] = static_cast<std::int32_t>(k);
    to.id[k] = from.id[o], to.position[k] = from.position[o], to.velocity[k] = from.velocity[o];
    to.spin[k] = from.spin[o], to.radius[k] = from.radius[o], to.mass[k] = from.mass[o],
    to.inertia[k] = from.inertia[o];
  }
  for (std::size_t k = 0; k < s.packing.links.size(); ++k) {
    Link<2>& l = s.packing.links[k];
    l.i = place[static_cast<std::size_t>(l.i)], l.j = place[static_cast<std::size_t>(l.j)];
    if (k % 2) {  // n and t turn round: force on the other body -(N n + T t) = N n' + T t', moment on it -M
      std::swap(l.i, l.j);
      l.shift = {-l.shift[0], -l.shift[1]};
      l.moment = -l.moment;
    }
  }
  std::shuffle(s.packing.links.begin(), s.packing.links.end(), engine);
  return s;
}

RC_GTEST_PROP(PhysicalHash, DoesNotSeeTheOrderOfStorage, (std::uint64_t seed)) {
  const State state = random_state(seed, *rc::gen::inRange(1, 12), *rc::gen::inRange(0, 20));
  State other = shuffled(state, seed + 1);
  RC_ASSERT(physical_hash(other) == physical_hash(state));
  other.memory = {};
  other.scene = {};
  other.progress = {};
  other.seed += 1, other.step += 1;
  RC_ASSERT(physical_hash(other) == physical_hash(state));
}

TEST(PhysicalHash, SeesEveryPhysicalNumber) {
  const State state = random_state(20, 6, 9);
  const std::string hash = physical_hash(state);
  const auto next = [](double& x) { x = std::nextafter(x, 10.0); };
  const std::vector<std::function<void(State&)>> changes{
      [&](State& s) { next(s.time); },
      [&](State& s) { next(s.law.rolling_friction); },
      [&](State& s) { next(s.packing.cell->length[1]); },
      [&](State& s) { s.packing.cell.reset(); },
      [&](State& s) { next(s.cell_motion.strain_rate[0]); },
      [&](State& s) { next(s.cell_motion.reference_length[1]); },
      [&](State& s) { s.packing.bodies.id[3] += 1000; },
      [&](State& s) { next(s.packing.bodies.position[5][1]); },
      [&](State& s) { next(s.packing.bodies.velocity[0][0]); },
      [&](State& s) { next(s.packing.bodies.spin[1]); },
      [&](State& s) { next(s.packing.bodies.radius[2]); },
      [&](State& s) { next(s.packing.bodies.mass[2]); },
      [&](State& s) { next(s.packing.bodies.inertia[2]); },
      [&](State& s) { s.packing.links.pop_back(); },
      [&](State& s) { s.packing.links[3].shift[0] += 1; },
      [&](State& s) {
        s.packing.links[3].kind = s.packing.links[3].kind == LinkKind::closed ? LinkKind::distant : LinkKind::closed;
      },
      [&](State& s) { next(s.packing.links[4].gap); },
      [&](State& s) { next(s.packing.links[4].normal_force); },
      [&](State& s) { next(s.packing.links[4].tangential_force); },
      [&](State& s) { s.packing.links[4].moment = -s.packing.links[4].moment; },
  };
  for (std::size_t k = 0; k < changes.size(); ++k) {
    State changed = state;
    changes[k](changed);
    EXPECT_NE(physical_hash(changed), hash) << "change " << k;
  }
  State zero = state, negative = state;
  zero.packing.bodies.spin[0] = 0.0, negative.packing.bodies.spin[0] = -0.0;
  EXPECT_EQ(physical_hash(zero), physical_hash(negative));
}

// The reader printed in docs/formats.md, run as it stands.
TEST(StateFile, IsReadByTheTenLinesOfTheDocumentation) {
  if (std::system("/usr/bin/python3 -c 'import h5py' 2>/dev/null") != 0)
    GTEST_SKIP() << "no /usr/bin/python3 with h5py";
  std::ifstream page(std::filesystem::path(ISOSTAT_DATA).parent_path() / "docs/formats.md");
  std::ostringstream text;
  text << page.rdbuf();
  const std::string fence = "```python\n", all = text.str();
  const std::size_t begin = all.find(fence) + fence.size();
  const Folder folder;
  State state = random_state(21, 4, 3);
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
