// What is meant by the force of a link.
#pragma once

namespace isostat {

enum class ForceMeasure { normal, total };  // |N|, or |F| = sqrt(N^2 + T^2)

}  // namespace isostat
