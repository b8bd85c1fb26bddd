// What a picture of a packing shows.
#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/figure/force_convention.hpp"
#include "analysis/figure/legend.hpp"
#include "analysis/figure/motion_marks.hpp"
#include "analysis/figure/picture_pen.hpp"
#include "analysis/stiffness/link_classes.hpp"

namespace isostat {

// Packing and pen of a system.
template <class Packing, class Pen>
class ContentOf {
 public:
  virtual ~ContentOf() = default;
  virtual double margin(const Packing&) const { return 0; }  // [length] needed around an isolated packing
  virtual void draw(Canvas& canvas, const Pen& pen) const = 0;
  virtual std::vector<LegendItem> legend(const Pen& pen, double em) const = 0;  // em: text size [pt]
};

using PictureContent = ContentOf<Packing<2>, PicturePen>;

// Disks, and the links between them as thin lines, distant pairs in blue.
std::unique_ptr<PictureContent> grains_content();

// Line widths in units of a, the largest diameter. Forces of order F0 are as wide as radii are (Sec. IV.B.1); the
// mean force without cohesion is slightly above a P, and the strong chains a few times it.
inline constexpr double kWidthAtF0 = 0.5, kWidthAtAP = 0.11;

struct ForceOptions {
  ForceConvention convention;
  double scale = 1;                    // F1 = max(F0, a P)
  double width_at_scale = kWidthAtF0;  // [a] line width of a force F1; kWidthAtAP where F1 = a P
  double diameter = 0;                 // [length] a; 0: of the largest grain of the picture
  RichText scale_label;                // its name; empty: written as a number
  std::vector<bool> rattler;           // one a body, or none
  std::vector<DiskShade> shade{};      // one a body; none: by links and rattlers
};
std::unique_ptr<PictureContent> forces_content(ForceOptions options);

// Arrows from the centres, and disks coloured by spin.
std::unique_ptr<PictureContent> motion_content(MotionOptions options);

// Rigid clusters: one colour each, different from the neighbours'; strong where the cluster is hyperstatic, pale where
// it is not; links between clusters grey.
struct ClusterOptions {
  std::vector<std::int32_t> of_grain, of_link;  // cluster, or -1
  std::vector<bool> hyperstatic;                // one a cluster
};
std::unique_ptr<PictureContent> clusters_content(ClusterOptions options);

// Clusters of stressed links: grains in the colour of their cluster, its links red or green by the sign of N and as
// wide as forces are; the other links faint.
struct StressedOptions {
  std::vector<std::int32_t> of_grain, of_link;  // cluster, or -1
  std::size_t clusters = 0;
  ForceMeasure width = ForceMeasure::total;
  double scale = 1;                    // F1
  double width_at_scale = kWidthAtF0;  // [a] line width of a force F1
  RichText scale_label, below;         // its name; what the faint links are
};
std::unique_ptr<PictureContent> stressed_content(StressedOptions options);

// What changed since another state (analysis/compare): grains in the colour of the region that moved rigidly, contacts
// kept, gained and lost, arrows of the displacements.
struct ChangesOptions {
  std::vector<std::int32_t> region_of_grain;  // or -1
  std::size_t regions = 0;
  std::vector<Link<2>> kept, gained, lost;  // between bodies of the packing that is drawn
  std::vector<Vec2> displacement;           // one a body
  RichText length_unit;
};
std::unique_ptr<PictureContent> changes_content(ChangesOptions options);

// Links by their class (analysis/stiffness/link_classes.hpp), one a link.
std::unique_ptr<PictureContent> loops_content(std::vector<LinkClass> classes);

// Pores under the disks, coloured by their equivalent radius; percolating void stays white.
struct PorePatch {
  Polygon wall;       // outer wall, in any image
  double area = 0;    // [length^2] larger ones are drawn first
  double radius = 0;  // [length] R_H; NaN: drawn as the smallest
};
struct PoreMapOptions {
  std::vector<PorePatch> pores;
  bool percolating = false;
  RichText length_unit;
  std::optional<std::array<double, 2>> range =
      std::nullopt;  // [length] radii at the ends of the colours; none: of these pores
};
// Smallest and largest radius; 0 without pores.
std::array<double, 2> radius_range(const std::vector<PorePatch>& pores);
std::unique_ptr<PictureContent> pores_content(PoreMapOptions options);

}  // namespace isostat
