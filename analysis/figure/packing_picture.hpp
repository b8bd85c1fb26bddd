// Picture of a packing: its grains, the forces between them, or their velocities.
#pragma once
#include <cstdint>
#include <vector>

#include "analysis/figure/canvas.hpp"
#include "analysis/figure/force_convention.hpp"
#include "analysis/figure/legend.hpp"
#include "analysis/figure/picture_frame.hpp"
#include "dem/packing.hpp"

namespace isostat {

enum class PictureKind {
  grains,    // disks, and the links between them as thin lines
  forces,    // force_convention.hpp
  velocity,  // arrows, and disks coloured by spin
  clusters   // rigid clusters: a colour each, strong where hyperstatic, pale where isostatic; hinges blue
};

// Line widths in units of a, the largest diameter. Forces of order F0 are as wide as radii are (Sec. IV.B.1); the
// mean force without cohesion is slightly above a P, and the strong chains a few times it.
inline constexpr double kWidthAtF0 = 0.5, kWidthAtAP = 0.11;

struct PictureOptions {
  PictureKind kind = PictureKind::grains;
  ForceConvention convention;
  double force_scale = 1;                       // F1 = max(F0, a P)
  double width_at_scale = kWidthAtF0;           // [a] line width of a force F1; kWidthAtAP where F1 = a P
  RichText force_scale_label;                   // its name; empty: written as a number
  RichText length_unit, speed_unit, spin_unit;  // for the scale bars; empty for a foreign packing
  std::vector<bool> rattler;                    // one a body, or none
  RichText speed_symbol = rich("`v`");          // what the arrows are
  std::vector<std::int32_t> cluster_of_grain;   // clusters: one a body, -1: in none
  std::vector<std::int32_t> cluster_of_link;    // clusters: one a link, -1: a hinge
  std::vector<bool> hyperstatic;                // by cluster
};

class PackingPicture {
 public:
  // Keeps a reference to the packing. Throws std::invalid_argument for a packing without bodies.
  PackingPicture(const Packing<2>& packing, PictureOptions options);
  Vec2 size() const { return size_; }  // [pt] of the page
  void draw(Canvas& canvas) const;

 private:
  void draw_disks(Canvas& canvas) const;
  void draw_links(Canvas& canvas) const;
  void draw_forces(Canvas& canvas) const;
  void draw_arrows(Canvas& canvas) const;
  void segments(Canvas& canvas, const std::vector<std::pair<const Link<2>*, double>>& links, const Color& color) const;
  double force_width(double force) const;  // [pt]
  double outline_width() const;            // [pt]
  std::vector<LegendItem> legend_items() const;
  void choose_motion_scales();

  const Packing<2>& packing_;
  PictureOptions options_;
  PictureFrame frame_;
  std::vector<DiskShade> shade_;
  double largest_diameter_ = 0;
  double arrow_scale_ = 0;                           // [pt per unit of velocity]
  double reference_speed_ = 0, reference_spin_ = 0;  // of the scale arrow, and the end of the colour bar
  double text_size_ = 9;
  Vec2 size_{};
  Vec2 legend_place_{};
  std::vector<Legend> legend_;
};

}  // namespace isostat
