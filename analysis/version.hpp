#pragma once
#include <string_view>

namespace isostat {
std::string_view version();  // of this build, as in CMakeLists.txt
}
