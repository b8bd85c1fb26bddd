// Arrows and spin colours of a picture of motion, for the grains of any system.
#pragma once
#include <algorithm>
#include <optional>
#include <span>
#include <vector>

#include "analysis/figure/legend.hpp"
#include "analysis/figure/picture_pen.hpp"

namespace isostat {

// What makes pictures comparable.
struct MotionScale {
  double largest = 0;     // speed
  double unit = 0;        // speed drawn as one mean diameter: the rms, unless the largest would be too long
  double spin_limit = 0;  // end of the colour bar; 0: nothing spins
};
MotionScale motion_scale(const std::vector<Vec2>& velocity, const std::vector<double>& spin);
inline MotionScale larger(const MotionScale& a, const MotionScale& b) {
  return {std::max(a.largest, b.largest), std::max(a.unit, b.unit), std::max(a.spin_limit, b.spin_limit)};
}

struct MotionOptions {
  std::vector<Vec2> velocity;  // one a body (of triangles: a grain)
  std::vector<double> spin;
  RichText symbol, spin_name;                       // in the legend: `v`, "spin"
  RichText speed_unit, spin_unit;                   // may be empty
  std::vector<RichText> notes;                      // more legend
  std::optional<MotionScale> scale = std::nullopt;  // of a series of pictures; none: of these velocities
};

class MotionMarks {
 public:
  explicit MotionMarks(MotionOptions options);
  const MotionOptions& options() const { return options_; }

  // The largest arrow may start at the edge of the outermost grain.
  double margin(double mean_diameter) const;
  std::vector<std::size_t> styles() const;                 // one a grain: index into paints()
  std::vector<Paint> paints(const Stroke& outline) const;  // shades of spin
  // Group "velocities": an arrow from each place, one a velocity.
  void draw_arrows(Canvas& canvas, const FramePen& pen, const std::vector<Vec2>& from) const;
  // Of those grains alone; in any image that shows.
  std::vector<Polygon> arrows(const FramePen& pen, const std::vector<Vec2>& from,
                              std::span<const std::size_t> grains) const;
  std::vector<LegendItem> legend(const FramePen& pen, double em) const;

 private:
  MotionOptions options_;
  MotionScale scale_;
};

}  // namespace isostat
