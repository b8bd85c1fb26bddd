#include "analysis/finishing/settling_network.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "dem/disks/at_rest.hpp"
#include "dem/state/balance.hpp"
#include "dem/state/touching.hpp"
#include "geometry/cell_grid.hpp"

namespace isostat {
namespace {

// In diameters of the smallest grain: how far one step may take a grain, and the gap up to which pairs are listed.
constexpr double kLargestStep = 0.08, kSkin = 0.64;
constexpr double kSlips = 1e-6;  // of its limit: nearer to it a contact slips

std::size_t at(std::int32_t k) { return static_cast<std::size_t>(k); }

struct Spring {
  std::int32_t i, j;
  ImageShift<2> shift;
  double tangential, moment;
};
auto key(const Spring& s) { return std::tie(s.i, s.j, s.shift); }

// i <= j, and for a grain and its own image a positive shift.
Spring canonical(Spring s) {
  const bool turn = s.i > s.j || (s.i == s.j && s.shift < ImageShift<2>{});
  return turn ? Spring{s.j, s.i, {-s.shift[0], -s.shift[1]}, s.tangential, -s.moment} : s;
}

// Elastic-perfectly plastic (law/friction.hpp): clamped to the limit coefficient * N_e.
struct Yielding {
  double force = 0;
  bool yields = false;
};
Yielding clamped(double trial, double limit) {
  if (std::abs(trial) <= limit) return {trial, false};
  return {std::copysign(limit, trial), true};
}

}  // namespace

SettlingNetwork::SettlingNetwork(const State<Disks>& state, const FinishingRequest<2>& request)
    : law_(state.law),
      stress_{request.stress[0], request.stress[1], request.stress.shear},
      periodic_(state.packing.cell.has_value()),
      tilts_(request.stress.shear || (periodic_ && state.packing.cell->tilt != 0)) {
  const Frame<2> frame = frame_of(state.packing.cell, state.packing.bodies.position);
  length_ = frame.length;
  const Bodies<2>& b = state.packing.bodies;
  order_.resize(b.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::sort(order_.begin(), order_.end(), [&](std::int32_t p, std::int32_t q) { return b.id[at(p)] < b.id[at(q)]; });
  std::vector<std::int32_t> rank(b.size());
  smallest_ = INFINITY;
  for (std::size_t r = 0; r < b.size(); ++r) {
    const std::size_t k = at(order_[r]);
    rank[k] = static_cast<std::int32_t>(r);
    position_.push_back(b.position[k]);
    radius_.push_back(b.radius[k]);
    inertia_.insert(inertia_.end(), {b.mass[k], b.mass[k], b.inertia[k]});
    smallest_ = std::min(smallest_, 2 * b.radius[k]), largest_ = std::max(largest_, 2 * b.radius[k]);
  }
  largest_step_ = kLargestStep * smallest_, skin_ = kSkin * smallest_;
  if (periodic_) tilt_ = state.packing.cell->tilt;
  if (!periodic_) length_ += Vec2{{largest_, largest_}};
  width_ = std::sqrt(area());
  for (int direction = 0; direction <= kShear; ++direction)
    if (stress_[at(direction)]) {
      const int a = branch_axis(direction);
      directions_.push_back(direction);
      inertia_.push_back(request.cell_inertia * area() / (width_ * width_) * length_[a] /
                         state.cell_motion.reference_length[a]);
    }
  for (const Link<2>& l : state.packing.links)
    if (is_contact(l.kind)) {
      const Spring s = canonical({rank[at(l.i)], rank[at(l.j)], l.shift, l.tangential_force, l.moment});
      Pair p;
      p.i = s.i, p.j = s.j, p.shift = s.shift, p.tangential = s.tangential, p.moment = s.moment;
      pairs_.push_back(p);
    }
  refresh();
  forces(std::vector<double>(size(), 0.0));
}

std::vector<double> SettlingNetwork::velocities(const State<Disks>& state) const {
  std::vector<double> v(size(), 0.0);
  const Bodies<2>& b = state.packing.bodies;
  for (std::size_t r = 0; r < grains(); ++r) {
    const std::size_t k = at(order_[r]);
    if (!counts(r)) continue;  // a rattler rests until it is met
    v[3 * r] = b.velocity[k][0], v[3 * r + 1] = b.velocity[k][1];
    if (law_.friction > 0 || law_.rolling_friction > 0) v[3 * r + 2] = b.spin[k];
  }
  for (std::size_t s = 0; s < directions_.size(); ++s) {
    const int a = branch_axis(directions_[s]);
    const CellMotion<2>& motion = state.cell_motion;
    const double rate = directions_[s] == kShear ? motion.shear_strain_rate : motion.strain_rate[a];
    v[3 * grains() + s] = width_ * rate * motion.reference_length[a] / length_[a];
  }
  return v;
}

// Lists every pair whose gap the next steps may close, and carries the springs over.
void SettlingNetwork::refresh() {
  std::vector<Spring> springs;
  for (const Pair& p : pairs_)
    if (p.tangential != 0 || p.moment != 0) springs.push_back({p.i, p.j, p.shift, p.tangential, p.moment});
  std::sort(springs.begin(), springs.end(), [](const Spring& a, const Spring& b) { return key(a) < key(b); });

  Packing<2> packing;
  if (periodic_) packing.cell = PeriodicCell<2>{length_, tilt_};
  packing.bodies.resize(grains());
  packing.bodies.position = position_, packing.bodies.radius = radius_;
  pairs_.clear();
  for (const Link<2>& l : touching_links(packing, law_.attraction_range + skin_)) {
    Pair p;
    p.i = l.i, p.j = l.j, p.shift = l.shift;
    const Spring probe{l.i, l.j, l.shift, 0, 0};
    const auto found = std::lower_bound(springs.begin(), springs.end(), probe,
                                        [](const Spring& a, const Spring& b) { return key(a) < key(b); });
    if (found != springs.end() && key(*found) == key(probe)) p.tangential = found->tangential, p.moment = found->moment;
    pairs_.push_back(p);
  }
  listed_at_ = position_, listed_length_ = length_, listed_tilt_ = tilt_;
  remember_branches();
  for (Pair& p : pairs_) p.coupled = p.gap < law_.attraction_range || p.gap < 0;
  make_pattern();
}

void SettlingNetwork::remember_branches() {
  const PeriodicCell<2> cell{length_, tilt_};
  for (Pair& p : pairs_) {
    p.branch = position_[at(p.j)] + cell.offset(p.shift) - position_[at(p.i)];
    p.gap = norm(p.branch) - radius_[at(p.i)] - radius_[at(p.j)];
  }
}

void SettlingNetwork::couple_active_pairs() {
  bool grows = false;
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    if (response_[k].active && !pairs_[k].coupled) grows = pairs_[k].coupled = true;
  if (grows) make_pattern();
}

// Columns of a grain: its own block, one block for every coupled neighbour of higher rank, the strains.
void SettlingNetwork::make_pattern() {
  const std::size_t n = grains();
  const auto strains = static_cast<std::int32_t>(directions_.size());
  blocks_.assign(n, 0);
  std::vector<std::vector<std::int32_t>> neighbours(n);
  for (Pair& p : pairs_) {  // sorted by (i, j, shift): images of one neighbour share a block
    if (!p.coupled || p.i == p.j) continue;
    std::vector<std::int32_t>& list = neighbours[at(p.i)];
    if (list.empty() || list.back() != p.j) list.push_back(p.j);
    p.slot = static_cast<std::int32_t>(list.size()) - 1;
  }
  SymmetricMatrix pattern;
  pattern.size = static_cast<std::int32_t>(size());
  pattern.start.push_back(0);
  for (std::size_t k = 0; k < n; ++k) {
    blocks_[k] = static_cast<std::int32_t>(neighbours[k].size());
    for (std::int32_t a = 0; a < 3; ++a) {
      for (std::int32_t b = a; b < 3; ++b) pattern.row.push_back(3 * static_cast<std::int32_t>(k) + b);
      for (std::int32_t j : neighbours[k])
        for (std::int32_t b = 0; b < 3; ++b) pattern.row.push_back(3 * j + b);
      for (std::int32_t s = 0; s < strains; ++s) pattern.row.push_back(3 * static_cast<std::int32_t>(n) + s);
      pattern.start.push_back(static_cast<std::int32_t>(pattern.row.size()));
    }
  }
  for (std::int32_t s = 0; s < strains; ++s) {
    for (std::int32_t q = s; q < strains; ++q) pattern.row.push_back(3 * static_cast<std::int32_t>(n) + q);
    pattern.start.push_back(static_cast<std::int32_t>(pattern.row.size()));
  }
  if (pattern.start == matrix_.start && pattern.row == matrix_.row) return;
  pattern.value.resize(pattern.row.size());
  matrix_ = std::move(pattern);
  ++patterns_;
}

// The slip is measured along the tangent of the mean branch vector, so that a rigid rotation stretches no spring to
// second order. A contact that forms within the step slips for the part of it that it exists, as in
// kernel/crossing.hpp.
SettlingNetwork::Response SettlingNetwork::respond(const Pair& p, const Vec2& r, double theta_i, double theta_j,
                                                   Links links) const {
  Response s;
  const double ri = radius_[at(p.i)], rj = radius_[at(p.j)], sum = ri + rj;
  s.frame = link_frame(r[0], r[1], ri, rj);
  const LinkFrame<double>& f = s.frame;
  s.held = links == Links::hold;
  if (!((s.held ? p.gap : f.gap) < 0)) {
    s.active = law_.attraction > 0 && (s.held ? p.gap : f.gap) < law_.attraction_range;
    if (!s.active) return s;
    const AtRest normal = distant(law_, f.gap);
    s.normal = normal.force, s.normal_stiffness = normal.stiffness;
    return s;
  }
  s.active = true;
  const AtRest normal = contact(law_, f.gap);
  s.normal = normal.force, s.normal_stiffness = normal.stiffness;
  if (!(law_.friction > 0) && !(law_.rolling_friction > 0)) return s;
  // A held contact does not begin to slip; one that slips already goes on under its last limit.
  const Limits now = limits(law_, f.gap), before = limits(law_, p.gap);
  const auto limit = [&](double Limits::*axis, double force) {
    if (!s.held) return now.*axis;
    return std::abs(force) < (1 - kSlips) * before.*axis ? INFINITY : before.*axis;
  };
  const double lasts = p.gap >= 0 ? f.gap / (f.gap - p.gap) : 1.0;  // part of the step in contact
  const double lasts_by_gap = p.gap >= 0 ? -p.gap / ((f.gap - p.gap) * (f.gap - p.gap)) : 0.0;
  if (law_.friction > 0) {
    const Vec2 mean = 0.5 * (p.branch + r);
    const double distance = norm(mean), turned = ri * theta_i + rj * theta_j;
    const double along = (p.branch[0] * r[1] - p.branch[1] * r[0]) / distance;  // t_mean . (r - r_accepted)
    const double slip = along - distance / sum * turned;
    const Yielding y =
        clamped(p.tangential - law_.tangential_stiffness * lasts * slip, limit(&Limits::tangential, p.tangential));
    s.tangential = y.force, s.slides = y.yields;
    if (y.yields) {
      if (!s.held) s.shear[0] = -std::copysign(law_.friction * law_.normal_stiffness, y.force);
    } else {
      // d(slip)/dr, as a vector, on the frame.
      const double half = 0.5 / distance * (along / distance + turned / sum);
      const double gx = -p.branch[1] / distance - half * mean[0], gy = p.branch[0] / distance - half * mean[1];
      const double k = -law_.tangential_stiffness * lasts;
      s.shear = {k * (gx * f.nx + gy * f.ny) - law_.tangential_stiffness * lasts_by_gap * slip,
                 k * (gy * f.nx - gx * f.ny), -k * distance / sum * ri, -k * distance / sum * rj};
    }
  }
  if (law_.rolling_friction > 0) {
    const double turn = theta_j - theta_i;
    const Yielding y = clamped(p.moment - law_.rolling_stiffness * lasts * turn, limit(&Limits::rolling, p.moment));
    s.moment = y.force, s.yields = y.yields;
    if (y.yields) {
      if (!s.held) s.roll[0] = -std::copysign(law_.rolling_friction * law_.normal_stiffness, y.force);
    } else {
      const double k = law_.rolling_stiffness * lasts;
      s.roll = {-law_.rolling_stiffness * lasts_by_gap * turn, 0, k, -k};
    }
  }
  return s;
}

const std::vector<double>& SettlingNetwork::forces(const std::vector<double>& step, Links links) {
  const std::size_t strain = 3 * grains();
  scale_ = {1, 1}, lean_ = 0;
  for (std::size_t s = 0; s < directions_.size(); ++s)
    if (directions_[s] == kShear)
      lean_ = step[strain + s] / width_;
    else
      scale_[at(directions_[s])] = std::exp(-step[strain + s] / width_);
  force_.assign(size(), 0.0);
  touching_.assign(grains(), 0);
  response_.resize(pairs_.size());
  std::array<double, 3> virial{};
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Pair& p = pairs_[k];
    const std::size_t i = 3 * at(p.i), j = 3 * at(p.j);
    const double x = p.branch[0] + (step[j] - step[i]), y = p.branch[1] + (step[j + 1] - step[i + 1]);
    const Vec2 r{{scale_[0] * (x - lean_ * y), scale_[1] * y}};
    const Response& s = response_[k] = respond(p, r, step[i + 2], step[j + 2], links);
    if (!s.active) continue;
    const LinkLoad<double> load = link_load(s.frame, s.normal, s.tangential, s.moment);
    force_[j] += load.fx, force_[j + 1] += load.fy, force_[j + 2] += load.moment_j;
    force_[i] -= load.fx, force_[i + 1] -= load.fy, force_[i + 2] += load.moment_i;
    virial[0] += load.fx * r[0], virial[1] += load.fy * r[1], virial[kShear] += load.fx * r[1];
    touching_[at(p.i)] = touching_[at(p.j)] = 1;
  }
  all_count_ = law_.attraction > 0 || std::none_of(touching_.begin(), touching_.end(), [](char t) { return t; });
  const double trial_area = area() * scale_[0] * scale_[1];
  for (std::size_t s = 0; s < directions_.size(); ++s) {
    const std::size_t a = at(directions_[s]);
    force_[strain + s] = (trial_area * *stress_[a] - virial[a]) / width_;
  }
  return force_;
}

// Minus the variation of (force on j along n, along t, moment on i, moment on j) with the displacements along n and t
// and the two rotations; the frame turns and the levers stretch.
SettlingNetwork::Tangent SettlingNetwork::tangent(const Pair& p, const Response& s, bool symmetric) const {
  const LinkFrame<double>& f = s.frame;
  const double sum = radius_[at(p.i)] + radius_[at(p.j)], r = f.distance;
  Tangent k{};
  std::array<double, 4> shear = s.shear, roll = s.roll;
  if (symmetric && s.slides) shear = {};
  if (symmetric && s.yields) roll = {};
  // What turns with the frame. Links that hold pass through forces far from those of the step's end on the way there.
  const double normal = s.held ? at_rest(law_, p.gap).force : s.normal;
  const double tangential = s.held ? p.tangential : s.tangential;
  k[0] = {s.normal_stiffness, tangential / r, 0, 0};
  k[1][1] = -normal / r;
  k[2][0] = tangential * radius_[at(p.i)] / sum;
  k[3][0] = tangential * radius_[at(p.j)] / sum;
  for (std::size_t c = 0; c < 4; ++c) {
    k[1][c] -= shear[c];
    k[2][c] += f.lever_i * shear[c] + roll[c];
    k[3][c] += f.lever_j * shear[c] - roll[c];
  }
  if (symmetric)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b) k[a][b] = k[b][a] = 0.5 * (k[a][b] + k[b][a]);
  return k;
}

std::vector<double> SettlingNetwork::stiffness_times(const std::vector<double>& x) const {
  const std::size_t strain = 3 * grains();
  std::vector<double> y(size(), 0.0);
  std::array<double, 3> e{}, edge{};
  for (std::size_t s = 0; s < directions_.size(); ++s) e[at(directions_[s])] = x[strain + s] / width_;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Response& s = response_[k];
    if (!s.active) continue;
    const Pair& p = pairs_[k];
    const LinkFrame<double>& f = s.frame;
    const std::size_t i = 3 * at(p.i), j = 3 * at(p.j);
    const double rx = f.nx * f.distance, ry = f.ny * f.distance;
    const double dx = scale_[0] * ((x[j] - x[i]) - lean_ * (x[j + 1] - x[i + 1])) - rx * e[0] -
                      scale_[0] / scale_[1] * ry * e[kShear];
    const double dy = scale_[1] * (x[j + 1] - x[i + 1]) - ry * e[1];
    const std::array<double, 4> q{f.nx * dx + f.ny * dy, f.nx * dy - f.ny * dx, x[i + 2], x[j + 2]};
    const Tangent t = tangent(p, s, false);
    std::array<double, 4> g{};
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < 4; ++b) g[a] += t[a][b] * q[b];
    const double fx = f.nx * g[0] - f.ny * g[1], fy = f.ny * g[0] + f.nx * g[1];
    y[j] += fx, y[j + 1] += fy, y[j + 2] += g[3];
    y[i] -= fx, y[i + 1] -= fy, y[i + 2] += g[2];
    edge[0] += -fx * rx + (s.normal * f.nx - s.tangential * f.ny) * dx;
    edge[1] += -fy * ry + (s.normal * f.ny + s.tangential * f.nx) * dy;
    edge[kShear] += -fx * ry + (s.normal * f.nx - s.tangential * f.ny) * dy;
  }
  const double trial_area = area() * scale_[0] * scale_[1];
  for (std::size_t s = 0; s < directions_.size(); ++s) {
    const std::size_t a = at(directions_[s]);
    y[strain + s] = (edge[a] + trial_area * *stress_[a] * (e[0] + e[1])) / width_;
  }
  return y;
}

const SymmetricMatrix& SettlingNetwork::shifted_stiffness(double shift) {
  const std::size_t strain = 3 * grains(), strains = directions_.size();
  couple_active_pairs();
  std::fill(matrix_.value.begin(), matrix_.value.end(), 0.0);
  for (std::size_t c = 0; c < size(); ++c) matrix_.value[at(matrix_.start[c])] += shift * inertia_[c];

  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Response& s = response_[k];
    if (!s.active) continue;
    const Pair& p = pairs_[k];
    const LinkFrame<double>& f = s.frame;
    const Tangent t = tangent(p, s, true);
    // B: rows of (normal, tangential, theta_i, theta_j) by (u_i, theta_i, u_j, theta_j, strains).
    double b[4][9] = {{-f.nx, -f.ny, 0, f.nx, f.ny, 0}, {f.ny, -f.nx, 0, -f.ny, f.nx, 0}};
    b[2][2] = 1, b[3][5] = 1;
    for (std::size_t q = 0; q < strains; ++q) {
      const bool along_x = force_axis(directions_[q]) == 0;
      const double n = along_x ? f.nx : f.ny, tau = along_x ? -f.ny : f.nx;
      const double height = branch_axis(directions_[q]) == 0 ? f.nx : f.ny;
      b[0][6 + q] = -n * height * f.distance / width_, b[1][6 + q] = -tau * height * f.distance / width_;
    }
    double kb[4][9] = {}, full[9][9];
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t c = 0; c < 6 + strains; ++c)
        for (std::size_t q = 0; q < 4; ++q) kb[a][c] += t[a][q] * b[q][c];
    for (std::size_t a = 0; a < 6 + strains; ++a)
      for (std::size_t c = 0; c < 6 + strains; ++c) {
        full[a][c] = 0;
        for (std::size_t q = 0; q < 4; ++q) full[a][c] += b[q][a] * kb[q][c];
      }
    const std::size_t i = 3 * at(p.i), j = 3 * at(p.j);
    const auto block_row = [&](std::size_t grain, std::size_t a) {  // first entry of column 3 grain + a
      return at(matrix_.start[3 * grain + a]);
    };
    for (std::size_t a = 0; a < 3; ++a) {
      for (std::size_t c = a; c < 3; ++c) {
        matrix_.value[block_row(i / 3, a) + c - a] += full[c][a];
        matrix_.value[block_row(j / 3, a) + c - a] += full[3 + c][3 + a];
        if (i == j) matrix_.value[block_row(i / 3, a) + c - a] += full[3 + c][a] + full[c][3 + a];
      }
      if (i != j)
        for (std::size_t c = 0; c < 3; ++c)
          matrix_.value[block_row(i / 3, a) + 3 - a + 3 * at(p.slot) + c] += full[3 + c][a];
      for (std::size_t q = 0; q < strains; ++q) {
        matrix_.value[block_row(i / 3, a) + 3 - a + 3 * at(blocks_[i / 3]) + q] += full[6 + q][a];
        matrix_.value[block_row(j / 3, a) + 3 - a + 3 * at(blocks_[j / 3]) + q] += full[6 + q][3 + a];
      }
    }
    for (std::size_t q = 0; q < strains; ++q)
      for (std::size_t c = q; c < strains; ++c)
        matrix_.value[at(matrix_.start[strain + q]) + c - q] += full[6 + c][6 + q];
  }
  return matrix_;
}

double SettlingNetwork::largest_displacement(const std::vector<double>& step) const {
  double most = 0;
  for (std::size_t r = 0; r < grains(); ++r)
    most = std::max({most, std::hypot(step[3 * r], step[3 * r + 1]), radius_[r] * std::abs(step[3 * r + 2])});
  for (std::size_t s = 0; s < directions_.size(); ++s)  // neighbours approach by e times their distance
    most = std::max(most, largest_ * std::abs(step[3 * grains() + s]) / width_);
  return most;
}

void SettlingNetwork::accept(const std::vector<double>& step) {
  for (std::size_t k = 0; k < pairs_.size(); ++k)
    pairs_[k].tangential = response_[k].tangential, pairs_[k].moment = response_[k].moment;
  tilt_ = scale_[0] * (tilt_ - lean_ * length_[1]);
  for (int a = 0; a < 2; ++a) length_[a] *= scale_[at(a)];
  // What the cell has done to heights since the lists were made, along the first axis.
  const double sheared = (tilt_ - length_[0] / listed_length_[0] * listed_tilt_) / listed_length_[1];
  double travel = 0;
  for (std::size_t r = 0; r < grains(); ++r) {
    const double x = position_[r][0] + step[3 * r], y = position_[r][1] + step[3 * r + 1];
    position_[r] = {{scale_[0] * (x - lean_ * y), scale_[1] * y}};
    Vec2 moved;
    for (int a = 0; a < 2; ++a) moved[a] = position_[r][a] - length_[a] / listed_length_[a] * listed_at_[r][a];
    moved[0] -= sheared * listed_at_[r][1];
    travel = std::max(travel, norm(moved));
  }
  travel = std::max(travel, largest_ * std::abs(sheared));
  for (int a = 0; a < 2; ++a) travel = std::max(travel, largest_ * std::abs(length_[a] / listed_length_[a] - 1));
  // A pair comes nearer by twice the travel of its grains and the strain; the next step adds as much again.
  if (3 * (travel + largest_step_) > skin_)
    refresh();
  else
    remember_branches();
  forces(std::vector<double>(size(), 0.0));
}

std::optional<double> SettlingNetwork::first_capture() const {
  std::optional<double> first;
  if (!cohesive()) return first;
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const double before = pairs_[k].gap, after = response_[k].frame.gap;
    for (const double reach : {0.0, law_.attraction_range})
      if (before >= reach && after < reach) first = std::min(first.value_or(1), (before - reach) / (before - after));
  }
  return first;
}

SettlingNetwork::Balance SettlingNetwork::balance() const {
  Balance b;
  for (std::size_t r = 0; r < grains(); ++r) {
    b.force = std::max(b.force, std::hypot(force_[3 * r], force_[3 * r + 1]));
    b.moment = std::max(b.moment, std::abs(force_[3 * r + 2]));
  }
  for (std::size_t s = 0; s < directions_.size(); ++s)
    b.stress = std::max(b.stress, std::abs(force_[3 * grains() + s]) * width_ / area());
  for (const Response& s : response_) b.sliding += s.slides, b.yielded += s.yields;
  return b;
}

void SettlingNetwork::store(State<Disks>& state, const std::vector<double>& velocity) const {
  Bodies<2>& b = state.packing.bodies;
  for (std::size_t r = 0; r < grains(); ++r) {
    const std::size_t k = at(order_[r]);
    b.position[k] = position_[r];
    b.velocity[k] = {{velocity[3 * r], velocity[3 * r + 1]}};
    b.spin[k] = velocity[3 * r + 2];
  }
  CellMotion<2>& motion = state.cell_motion;
  if (periodic_) {
    const PeriodicCell<2> before = *state.packing.cell;
    *state.packing.cell = {length_, tilt_};
    if (stress_[kShear])
      motion.shear_strain += (tilt_ - length_[0] / before.length[0] * before.tilt) / before.length[1];
  }
  for (std::size_t s = 0; s < directions_.size(); ++s) {
    const int a = branch_axis(directions_[s]);
    (directions_[s] == kShear ? motion.shear_strain_rate : motion.strain_rate[a]) =
        velocity[3 * grains() + s] / width_ * length_[a] / motion.reference_length[a];
  }
  state.packing.links.clear();
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Response& s = response_[k];
    if (!s.active) continue;
    const Pair& p = pairs_[k];
    Link<2> l;
    l.i = order_[at(p.i)], l.j = order_[at(p.j)], l.shift = p.shift, l.gap = s.frame.gap;
    l.normal_force = s.normal, l.tangential_force = s.tangential, l.moment = s.moment;
    l.kind = kind_of(state.law, l.gap, l.tangential_force, l.moment);
    state.packing.links.push_back(l);
  }
  if (periodic_) {
    const StressTensor stress = measured_stress(state.packing);
    motion.stress = {{stress.xx, stress.yy}};
    if (stress_[kShear]) motion.shear_stress = stress.xy;
  }
  state.memory = {};
}

template <class Network, class Io>
void SettlingNetwork::transfer_members(Network& n, Io& io) {
  transfer_vectors(io, n.position_);
  transfer_vectors(io, n.listed_at_);
  io.vector(n.length_);
  io.vector(n.listed_length_);
  if (n.tilts_) io.real(n.tilt_), io.real(n.listed_tilt_);
  const std::size_t pairs = io.count(n.pairs_);
  for (std::size_t k = 0; k < pairs; ++k) {
    auto& p = n.pairs_[k];
    std::int32_t coupled = p.coupled;
    io.whole(p.i), io.whole(p.j), io.whole(p.shift[0]), io.whole(p.shift[1]), io.whole(coupled);
    io.real(p.tangential), io.real(p.moment);
    if constexpr (!Io::writes) p.coupled = coupled != 0;
  }
}

void SettlingNetwork::transfer(SolveWriter& io) const { transfer_members(*this, io); }

void SettlingNetwork::transfer(SolveReader& io) {
  const std::size_t n = grains();
  transfer_members(*this, io);
  SolveReader::require(position_.size() == n && listed_at_.size() == n && length_[0] > 0 && length_[1] > 0 &&
                       listed_length_[0] > 0 && listed_length_[1] > 0);
  const auto order = [](const Pair& p) { return std::tie(p.i, p.j, p.shift); };
  for (std::size_t k = 0; k < pairs_.size(); ++k) {
    const Pair& p = pairs_[k];
    SolveReader::require(p.i >= 0 && p.i <= p.j && at(p.j) < n && (k == 0 || order(pairs_[k - 1]) < order(p)));
  }
  remember_branches();
  make_pattern();
  forces(std::vector<double>(size(), 0.0));
}

}  // namespace isostat
