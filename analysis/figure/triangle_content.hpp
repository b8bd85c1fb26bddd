// What a picture of grains of triangles shows.
#pragma once
#include <array>
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

// Of each free grain the velocity of its centre of mass, and its spin: angular momentum over moment of inertia. Of any
// motion of the bodies: of a mode's displacements, too.
struct GrainMotion {
  std::vector<std::size_t> grain;
  std::vector<Vec2> centre;  // [cm]
  std::vector<Vec2> velocity;
  std::vector<double> spin;
};
GrainMotion grain_motion(const TrianglePacking& packing, const std::vector<Vec2>& velocity,
                         const std::vector<double>& spin);
// Takes velocity and spin of the options from the motion.
std::unique_ptr<TriangleContent> triangle_motion_content(GrainMotion motion, MotionOptions options);

// Triangles in the colours of their rigid clusters, as disks.
struct TriangleClusterOptions {
  std::vector<std::int32_t> of_body;              // cluster of each triangle, or -1; of walls whatever it is
  std::vector<std::array<std::int32_t, 2>> meet;  // clusters that are neighbours
  std::vector<bool> hyperstatic;                  // one a cluster
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
