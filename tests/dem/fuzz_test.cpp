// The fuzz targets on the shipped files and deterministic mutations of them: a floor under what libFuzzer explores.
#include <gtest/gtest.h>

#include <functional>
#include <random>

#include "dem/input_error.hpp"
#include "dem/scene/file.hpp"
#include "tests/fuzz/fuzz_targets.hpp"
#include "tests/fuzz/seeds.hpp"

namespace isostat {
namespace {

std::string mutated(std::string bytes, std::mt19937_64& engine) {
  const auto below = [&](std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(engine); };
  const std::size_t edits = 1 + below(4);
  for (std::size_t e = 0; e < edits && !bytes.empty(); ++e) {
    const std::size_t at = below(bytes.size()), span = std::min(bytes.size() - at, 1 + below(16));
    switch (below(5)) {
      case 0:
        bytes[at] = static_cast<char>(engine());
        break;
      case 1:
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << below(8)));
        break;
      case 2:
        bytes.erase(at, span);
        break;
      case 3:
        bytes.insert(at, bytes.substr(below(bytes.size()), span));
        break;
      default:
        bytes.replace(at, span, span, "\0\xff\x7f\x80 9.-=[\n"[below(11)]);
        break;
    }
  }
  return bytes;
}

void run(const std::function<void(std::string_view)>& target, const std::vector<std::string>& corpus, int rounds) {
  ASSERT_FALSE(corpus.empty());
  std::mt19937_64 engine(20070406);
  for (const std::string& bytes : corpus) {
    ASSERT_NO_THROW(target(bytes));
    for (int k = 0; k < rounds; ++k) {
      const std::string bad = mutated(bytes, engine);
      ASSERT_NO_THROW(target(bad)) << bad;
    }
  }
}

TEST(Fuzz, Scene) { run(fuzz_scene, scene_seeds(ISOSTAT_DATA), 2000); }
TEST(Fuzz, Network) { run(fuzz_network, network_seeds(ISOSTAT_DATA), 300); }
TEST(Fuzz, State) { run(fuzz_state, state_seeds(ISOSTAT_DATA), 50); }

TEST(Fuzz, Packing) { run(fuzz_packing, packing_seeds(ISOSTAT_DATA), 30); }

TEST(Fuzz, DeepNesting) {
  std::string dotted, tables, arrays = "seed = ";
  for (int k = 0; k < 200000; ++k) dotted += "a.", tables += "[a]\n", arrays += "[";
  fuzz_scene(dotted + "a = 1");
  fuzz_scene(tables);
  fuzz_scene(arrays);
  const std::string allowed = dotted.substr(0, 4000);
  fuzz_scene("[" + allowed + "a]\n" + allowed + "a = 1");
  EXPECT_THROW(parse_scene("seed = 1\n" + dotted + "a = 1", "deep"), InputError);
}

}  // namespace
}  // namespace isostat
