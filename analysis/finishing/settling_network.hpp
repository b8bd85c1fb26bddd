// The grains and candidate links of a packing that settles: forces of the full static law at a trial configuration,
// with the springs as elastic-plastic increments from the last accepted one, and their exact tangent.
//
// Unknowns of a step, in the order of the grains' ids: displacement u_i [a] and rotation theta_i of every grain, then
// for each edge of the cell under stress control its log-strain e_a = -ln(L_a / L_a,accepted), compression positive,
// times w = sqrt(area) [a], and for a shear stress that is imposed the shear strain e_12 times w, in the same sense.
// Positions move with the cell: with (x, y) = r_ij,accepted + u_j - u_i
//   r_ij = (exp(-e_1) (x - e_12 y), exp(-e_2) y),
// so that each strain is the whole of its component of the velocity gradient, at any value of the others.
// Conjugate forces: net force F_i [F0], moment [F0 a], and (A sigma_imposed - sum F_a r_b) / w [F0].
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "analysis/finishing/solve_memory.hpp"
#include "analysis/stiffness/sparse_cholesky.hpp"
#include "dem/disks/disks.hpp"
#include "dem/run/finishing.hpp"
#include "dem/state/link.hpp"

namespace isostat {

// The law as it is; or the links as they are: contacts hold, stretched at their stiffness, and do not begin to slip,
// and no pair beyond reach acts. A step that changes no link ends in the same place either way. But on the way there a
// trial step easily stretches contacts by more than their deflection F0 / K_N, where they have a negative stiffness.
enum class Links { act, hold };

class SettlingNetwork {
 public:
  SettlingNetwork(const State<Disks>& state, const FinishingRequest<2>& request);

  std::size_t grains() const { return position_.size(); }
  std::size_t size() const { return 3 * grains() + directions_.size(); }
  // Inertia of each unknown: m, I, and M A (L / L0) / w^2 of the cell.
  const std::vector<double>& inertia() const { return inertia_; }
  // Velocities of the state, by unknown; and the other way round.
  std::vector<double> velocities(const State<Disks>& state) const;

  // Forces at a trial step; keeps what the tangent needs. Pairs are found up to a skin: see refresh().
  const std::vector<double>& forces(const std::vector<double>& step, Links links = Links::act);
  const std::vector<double>& forces() const { return force_; }

  // K x with K = -d(force)/d(step) at the configuration of the last forces(): not symmetric with friction.
  std::vector<double> stiffness_times(const std::vector<double>& x) const;
  // Its symmetric part with yielded springs left out, plus inertia * shift, lower triangle. Pairs out of reach have no
  // place in it; the pattern grows when one of them comes to act: patterns() counts the different ones.
  const SymmetricMatrix& shifted_stiffness(double shift);
  std::int64_t patterns() const { return patterns_; }

  // Takes the trial step of the last forces() as the new accepted configuration, springs included.
  void accept(const std::vector<double>& step);
  double largest_step() const { return largest_step_; }  // [a] that keeps candidate pairs and linear trials honest
  double largest_displacement(const std::vector<double>& step) const;  // [a] of a grain's centre or rim

  // At the accepted configuration with the forces of forces(zero).
  struct Balance {
    double force = 0, moment = 0, stress = 0;  // largest, [F0], [F0 a], [F0/a]
    std::int64_t sliding = 0, yielded = 0;
  };
  Balance balance() const;
  // In the kinetic criterion (evaluate_certificate): without cohesion a grain that touches nothing does not, unless
  // none touches.
  bool counts(std::size_t grain) const { return all_count_ || touching_[grain]; }
  bool cohesive() const { return law_.attraction > 0; }
  // The part of the trial step of the last forces() after which it first brings a cohesive pair within reach or into
  // contact, if it does.
  std::optional<double> first_capture() const;
  // L1 and L2 of the cell; of an isolated packing those of the box of its grains [a].
  const Vec2& extent() const { return length_; }
  double area() const { return length_[0] * length_[1]; }

  // The accepted configuration with its lists, as dem/disks/disks.hpp keeps it.
  void transfer(SolveWriter& io) const;
  void transfer(SolveReader& io);

  // Puts the accepted configuration and the given velocities into a state; its memory is emptied.
  void store(State<Disks>& state, const std::vector<double>& velocity) const;

 private:
  struct Pair {  // candidate link, i <= j in the order of ids
    std::int32_t i = 0, j = 0;
    ImageShift<2> shift{};
    double tangential = 0, moment = 0;  // history at the accepted configuration [F0], [F0 a]
    Vec2 branch{};                      // r_ij there
    double gap = 0;
    bool coupled = false;   // has a block in the pattern: it has been active since the last refresh
    std::int32_t slot = 0;  // off-diagonal block of the pattern, in column i
  };
  struct Response {  // at the trial configuration
    LinkFrame<double> frame{};
    double normal = 0, tangential = 0, moment = 0;  // N, T, M
    double normal_stiffness = 0;                    // -dN/dh; 0 without interaction
    // dT and dM per (normal displacement, tangential displacement, theta_i, theta_j).
    std::array<double, 4> shear{}, roll{};
    bool active = false, slides = false, yields = false, held = false;
  };
  using Tangent = std::array<std::array<double, 4>, 4>;

  Response respond(const Pair& pair, const Vec2& branch, double theta_i, double theta_j, Links links) const;
  Tangent tangent(const Pair& pair, const Response& response, bool symmetric) const;
  template <class Network, class Io>
  static void transfer_members(Network& network, Io& io);
  void refresh();
  void remember_branches();
  void couple_active_pairs();
  void make_pattern();
  // A direction of strain is an edge, or the shear: force along the first axis, height along the second.
  static constexpr int kShear = 2;
  static int force_axis(int direction) { return direction == kShear ? 0 : direction; }
  static int branch_axis(int direction) { return direction == kShear ? 1 : direction; }

  DiskLaw law_;
  std::array<std::optional<double>, 3> stress_;  // of each direction
  bool periodic_, tilts_;
  std::vector<int> directions_;
  std::vector<std::int32_t> order_;  // storage index by rank of the id
  std::vector<Vec2> position_, listed_at_;
  std::vector<double> radius_, inertia_;
  Vec2 length_{}, listed_length_{};
  double tilt_ = 0, listed_tilt_ = 0;
  double width_ = 1, smallest_ = 0, largest_ = 0, largest_step_ = 0, skin_ = 0;

  std::vector<Pair> pairs_;
  std::vector<Response> response_;
  std::vector<char> touching_;
  bool all_count_ = true;
  std::vector<double> force_;
  std::array<double, 2> scale_{1, 1};  // exp(-e) of the trial
  double lean_ = 0;                    // e_12
  SymmetricMatrix matrix_;
  std::vector<std::int32_t> blocks_;  // off-diagonal blocks of each grain's columns
  std::int64_t patterns_ = 0;
};

}  // namespace isostat
