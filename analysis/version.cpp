#include "analysis/version.hpp"

namespace isostat {
std::string_view version() { return ISOSTAT_VERSION; }
}  // namespace isostat
