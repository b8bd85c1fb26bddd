// What a picture of grains of triangles shows.
#pragma once
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "analysis/figure/force_convention.hpp"
#include "analysis/figure/motion_marks.hpp"
#include "analysis/figure/picture_subject.hpp"
#include "analysis/figure/triangle_pen.hpp"

namespace isostat {

using TriangleContent = ContentOf<TrianglePacking, TrianglePen>;

std::unique_ptr<TriangleContent> triangle_grains_content();

// A bar at each overlap along its normal, and the beams that carry a load, paler; both as wide as their forces.
struct TriangleForceOptions {
  ForceConvention convention;  // green: only beams pull
  double scale = 1;            // [dyn] a force that is kWidthAtAP mean diameters wide
  std::vector<bool> rattler;   // one a grain, or none at all
};
// [dyn] mean normal force of the overlaps; 0 without any.
double mean_overlap_force(const TrianglePacking& packing);
std::unique_ptr<TriangleContent> triangle_forces_content(TriangleForceOptions options);

// Velocity of the centre of mass of each grain, and its spin: angular momentum over moment of inertia. Of any motion of
// the bodies: a mode's displacements, too.
struct GrainMotion {
  std::vector<Vec2> centre;    // [cm]
  std::vector<Vec2> velocity;  // one a grain; walls and lids are at rest
  std::vector<double> spin;
};
GrainMotion grain_motion(const TrianglePacking& packing, const std::vector<Vec2>& velocity,
                         const std::vector<double>& spin);
// options.velocity and options.spin: one a grain.
std::unique_ptr<TriangleContent> triangle_motion_content(std::vector<Vec2> centre, MotionOptions options);

// Colours by cluster, as for disks.
struct TriangleClusterOptions {
  std::vector<std::int32_t> of_body;  // cluster of each triangle, or -1
  std::vector<bool> hyperstatic;      // one a cluster
};
std::unique_ptr<TriangleContent> triangle_clusters_content(TriangleClusterOptions options);

// Keeps a reference to the packing.
class TriangleSubject final : public PictureSubject {
 public:
  TriangleSubject(const TrianglePacking& packing, std::unique_ptr<TriangleContent> content,
                  std::optional<Room> room = std::nullopt)
      : packing_(packing), content_(std::move(content)), room_(room) {}
  Extent extent() const override { return extent_of(packing_, room_, content_->margin(packing_)); }
  void draw(Canvas& canvas, const PictureFrame& frame) const override {
    content_->draw(canvas, TrianglePen(packing_, frame));
  }
  std::vector<LegendItem> legend(const PictureFrame& frame, double em) const override {
    return content_->legend(TrianglePen(packing_, frame), em);
  }

 private:
  const TrianglePacking& packing_;
  std::unique_ptr<TriangleContent> content_;
  std::optional<Room> room_;
};

}  // namespace isostat
