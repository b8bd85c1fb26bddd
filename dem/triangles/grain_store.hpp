// The grains as the kernels see them. Eight grains of one topology (as many triangles, joined by the same beams) are a
// block, a lane each: every array over triangles holds lane by lane the first triangles of the eight, then the second,
// ... (GrainBlock), and so do the arrays over beams. So motion and beams need no gather, whatever the shapes. Free
// grains come first, then those that move with the container. The last block of a topology is filled up with copies
// that feel nothing and never move.
//
// For the neighbour lists (dem/solver/neighbours.hpp) the bodies are grains with the circle that holds them; a smooth
// wall, much larger than the grains, is none of theirs and stands at the end.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "dem/solver/aligned.hpp"
#include "dem/triangles/kernel/triangle_kernels.hpp"
#include "dem/triangles/triangles.hpp"

namespace isostat {

class GrainStore {
 public:
  // All of a packing, in its order of grains; memory may be empty. Beams take gamma from the law.
  void load(const TrianglePacking& packing, const TriangleLaw& law, const TriangleMemory& memory);

  // ---- for the lists: grains [0, listed()) ----
  std::vector<std::int64_t> id;
  std::size_t size() const { return listed_; }
  Vec2 position(std::size_t k) const { return centre_[k]; }
  double radius(std::size_t k) const { return radius_[k]; }
  double largest_radius() const;
  void place(std::size_t k, const Vec2& r);
  void reorder(const std::vector<std::int32_t>& to);
  static constexpr std::size_t kPads = 64;
  static constexpr std::size_t pad(std::size_t n, std::size_t k) { return n + 2 * k; }

  // ---- grains in the lists' order, smooth walls after them ----
  std::size_t grains() const { return id.size(); }
  bool driven(std::size_t g) const { return part_[g] != GrainPart::free; }
  GrainPart part(std::size_t g) const { return part_[g]; }
  double inverse_length(std::size_t g) const { return inverse_length_[g]; }
  std::size_t triangles(std::size_t g) const { return topology_[g]->triangles; }
  std::size_t beams(std::size_t g) const { return topology_[g]->joined.size(); }
  const std::array<std::uint16_t, 2>& joined(std::size_t g, std::size_t b) const { return topology_[g]->joined[b]; }
  static constexpr std::uint32_t kStride = 8;  // between the slots of a grain's triangles: lanes of a block
  std::size_t slot(std::size_t g, std::size_t t) const { return slot_[g] + kStride * t; }
  std::size_t beam_place(std::size_t g, std::size_t b) const { return beam_slot_[g] + kStride * b; }
  // Centres, and the radii within which the grains are, from the rows as they stand.
  void measure_circles();
  double tight(std::size_t g) const { return tight_[g]; }
  // Larger circles for grains that have outgrown theirs. True: there were none.
  bool grow_circles();

  // ---- blocks and arrays ----
  const std::vector<GrainBlock>& blocks() const { return blocks_; }
  std::size_t free_slots() const { return free_slots_; }  // a multiple of 8; driven ones after them
  std::size_t slots() const { return slots_; }
  // Two far-apart triangles, for lanes with nothing to do; one pair of them for each group of threads.
  std::uint32_t pad_slot(std::size_t group) const { return static_cast<std::uint32_t>(slots_ + 2 * (group % kPads)); }
  std::size_t most_work() const { return most_work_; }  // doubles that the beam kernel works in
  GrainArrays arrays();

  // Columns over slots, in the order of `Column`.
  enum Column : std::uint8_t {
    x,
    y,
    angle,
    cosine,
    sine,
    ux,
    uy,
    uw,
    px,
    py,
    pw,
    fx,
    fy,
    torque,
    mass,
    inverse_mass,
    inverse_inertia,
    inertia,
    reach,
    heavy,
    corner0,
    corner1,
    corner2,
    corner3,
    corner4,
    corner5,
    bx,
    by,
    bw,
    cx,
    cy,
    cw,  // Gear: b dt^3/6, c dt^4/24
    ax,
    ay,
    aw,  // Gear: a dt^2/2 as predicted, until it is corrected
    built_x,
    built_y,
    built_angle,  // where candidates were last looked for
    wall_x,
    wall_y,
    wall_angle,  // of driven ones: where the stage found them
    columns
  };
  AlignedVector<double>& operator[](Column c) { return column_[c]; }
  const AlignedVector<double>& operator[](Column c) const { return column_[c]; }
  enum BeamColumn : std::uint8_t {
    length,
    xi,
    yi,
    xj,
    yj,
    stretching,
    bending,
    damping,
    bending_damping,
    rest_i,
    rest_j,
    bending_stiffness,
    beam_columns
  };
  AlignedVector<double>& beam(BeamColumn c) { return beam_column_[c]; }
  const AlignedVector<double>& beam(BeamColumn c) const { return beam_column_[c]; }
  // Brings what the kernels use of a beam up to its rest values and stiffnesses.
  void set_beam(std::size_t place, const Beam& beam, double gamma);
  Beam beam_at(std::size_t place) const;
  AlignedVector<double> rows, loads;
  std::vector<std::int64_t> body_id;  // of slots

 private:
  struct Topology {
    std::uint16_t triangles;
    bool driven;
    std::vector<std::array<std::uint16_t, 2>> joined;
    auto operator<=>(const Topology&) const = default;
  };
  // Gives every grain its slots, in the order of topologies and of grains.
  void lay_out();
  void fill_padding();

  std::size_t listed_ = 0, slots_ = 0, free_slots_ = 0, beam_slots_ = 0, most_work_ = 0;
  std::vector<Topology> topologies_;       // sorted: free ones first
  std::vector<const Topology*> topology_;  // of grains
  std::vector<GrainPart> part_;
  std::vector<double> radius_, tight_, inverse_length_;
  std::vector<Vec2> centre_;
  std::vector<std::size_t> slot_, beam_slot_;
  std::vector<GrainBlock> blocks_;
  std::array<AlignedVector<double>, columns> column_;
  std::array<AlignedVector<double>, beam_columns> beam_column_;
};

}  // namespace isostat
