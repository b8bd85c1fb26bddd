// The instruction sets that kernels are compiled for.
#pragma once
#include <cstdint>
#include <string_view>

namespace isostat {

enum class Isa : std::uint8_t { scalar, avx2, avx512 };
Isa machine_isa();  // the most that this machine and build have
std::string_view name(Isa isa);

}  // namespace isostat
