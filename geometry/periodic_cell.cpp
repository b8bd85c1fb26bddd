#include "geometry/periodic_cell.hpp"

namespace isostat {
template struct PeriodicCell<2>;
template struct PeriodicCell<3>;
}  // namespace isostat
