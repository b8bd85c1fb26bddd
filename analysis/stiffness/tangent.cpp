// The full tangent with prestress (geometric term) and the moduli that follow from it.
#include <umfpack.h>

#include <algorithm>
#include <cmath>

#include "analysis/stiffness/moduli.hpp"
#include "analysis/stiffness/stiffness_matrix.hpp"
#include "dem/link.hpp"

namespace isostat {
namespace {

// What one link does when its two bodies and the cell move by an infinitesimal amount.
struct LinkTangent {
  const LinkFrame<double>& f;
  double radius_i, radius_j;
  double normal, tangential, moment;  // forces now
  double k_normal, k_tangential, k_moment;

  struct Response {
    double fx, fy, moment_i, moment_j;  // change of the force on j (opposite on i) and of the moments
  };
  Response operator()(double dx, double dy, double spin_i, double spin_j) const {
    const auto v = link_velocity(f, dx, dy, spin_i, spin_j);
    const double dn = -k_normal * v.normal, dt = -k_tangential * v.tangential, dm = -k_moment * v.rolling;
    const double tx = -f.ny, ty = f.nx;
    const double turn = (tx * dx + ty * dy) / f.distance;  // of the frame
    const double stretch = v.normal / (radius_i + radius_j);
    return {dn * f.nx + dt * tx + turn * (normal * tx - tangential * f.nx),
            dn * f.ny + dt * ty + turn * (normal * ty - tangential * f.ny),
            -dt * f.lever_i - tangential * stretch * radius_i - dm,
            -dt * f.lever_j - tangential * stretch * radius_j + dm};
  }
};

struct Triplets {
  std::vector<std::int32_t> row, column;
  std::vector<double> value;
  void add(std::int32_t r, std::int32_t c, double v) {
    if (r >= 0 && c >= 0 && v != 0) row.push_back(r), column.push_back(c), value.push_back(v);
  }
};

// Solves A x = b for several b; A by triplets, n x n.
std::vector<std::vector<double>> solve_unsymmetric(std::int32_t n, const Triplets& t,
                                                   const std::vector<std::vector<double>>& b) {
  std::vector<std::int32_t> start(static_cast<std::size_t>(n) + 1), index(t.value.size());
  std::vector<double> value(t.value.size());
  if (umfpack_di_triplet_to_col(n, n, static_cast<std::int32_t>(t.value.size()), t.row.data(), t.column.data(),
                                t.value.data(), start.data(), index.data(), value.data(), nullptr) != UMFPACK_OK)
    throw FactorisationFailed("UMFPACK cannot assemble the tangent");
  void *symbolic = nullptr, *numeric = nullptr;
  double info[UMFPACK_INFO];
  int status = umfpack_di_symbolic(n, n, start.data(), index.data(), value.data(), &symbolic, nullptr, info);
  if (status == UMFPACK_OK)
    status = umfpack_di_numeric(start.data(), index.data(), value.data(), symbolic, &numeric, nullptr, info);
  umfpack_di_free_symbolic(&symbolic);
  std::vector<std::vector<double>> x;
  for (const auto& right : b) {
    if (status != UMFPACK_OK) break;
    x.emplace_back(static_cast<std::size_t>(n));
    status = umfpack_di_solve(UMFPACK_A, start.data(), index.data(), value.data(), x.back().data(), right.data(),
                              numeric, nullptr, info);
  }
  umfpack_di_free_numeric(&numeric);
  if (status == UMFPACK_WARNING_singular_matrix) throw FactorisationFailed("the tangent stiffness is singular");
  if (status != UMFPACK_OK) throw FactorisationFailed("UMFPACK status " + std::to_string(status));
  return x;
}

double antisymmetric_ratio(std::int32_t n, const Triplets& t) {
  std::vector<std::int32_t> start(static_cast<std::size_t>(n) + 1), index(2 * t.value.size());
  double norms[2];
  for (int sign : {-1, 1}) {
    Triplets both = t;
    for (std::size_t e = 0; e < t.value.size(); ++e) both.add(t.column[e], t.row[e], sign * t.value[e]);
    std::vector<double> value(both.value.size());
    umfpack_di_triplet_to_col(n, n, static_cast<std::int32_t>(both.value.size()), both.row.data(), both.column.data(),
                              both.value.data(), start.data(), index.data(), value.data(), nullptr);
    double sum = 0;
    for (std::size_t e = 0; e < static_cast<std::size_t>(start.back()); ++e) sum += value[e] * value[e];
    norms[sign > 0] = std::sqrt(sum);
  }
  return norms[1] > 0 ? norms[0] / norms[1] : 0;
}

}  // namespace

TangentModuli tangent_moduli(const Packing<2>& packing, NetworkLaw network_law, const LawParameters& law) {
  const RigidityMatrix g = rigidity_matrix(packing, network_law, false);
  const std::vector<double> stiffness = row_stiffness(packing, g, law);
  const std::int32_t per_body = g.layout.per_body;
  const auto count = packing.bodies.size();

  // Unknowns: bodies with links, the first of each connected piece held against translation.
  std::vector<std::int32_t> piece(count, -1), unknown(count * static_cast<std::size_t>(per_body), -1);
  std::vector<std::vector<std::int32_t>> neighbours(count);
  for (const Link<2>& l : packing.links) {
    neighbours[static_cast<std::size_t>(l.i)].push_back(l.j);
    neighbours[static_cast<std::size_t>(l.j)].push_back(l.i);
  }
  std::int32_t size = 0;
  for (std::size_t root = 0; root < count; ++root) {
    if (piece[root] >= 0 || neighbours[root].empty()) continue;
    std::vector<std::size_t> stack = {root};
    piece[root] = static_cast<std::int32_t>(root);
    while (!stack.empty()) {
      const std::size_t at = stack.back();
      stack.pop_back();
      for (std::int32_t d = at == root ? 2 : 0; d < per_body; ++d)
        unknown[at * static_cast<std::size_t>(per_body) + static_cast<std::size_t>(d)] = size++;
      for (std::int32_t next : neighbours[at])
        if (piece[static_cast<std::size_t>(next)] < 0)
          piece[static_cast<std::size_t>(next)] = static_cast<std::int32_t>(root),
          stack.push_back(static_cast<std::size_t>(next));
    }
  }

  struct LinkStiffness {
    double normal = 0, tangential = 0, moment = 0;
  };
  std::vector<LinkStiffness> k(packing.links.size());
  for (std::size_t r = 0; r < stiffness.size(); ++r) {
    LinkStiffness& of = k[static_cast<std::size_t>(g.link_of_row[r])];
    (g.component[r] == 0 ? of.normal : g.component[r] == 1 ? of.tangential : of.moment) = stiffness[r];
  }

  Triplets tangent;
  std::vector<std::vector<double>> load(3, std::vector<double>(static_cast<std::size_t>(size), 0.0));
  // stress[a] as a linear function of the unknowns, and its direct part from the strains.
  std::vector<std::vector<double>> stress_of(3, std::vector<double>(static_cast<std::size_t>(size), 0.0));
  Moduli direct{};
  std::array<double, 3> stress_now{};
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<2>& link = packing.links[l];
    const auto i = static_cast<std::size_t>(link.i), j = static_cast<std::size_t>(link.j);
    Vec2 r = packing.bodies.position[j] - packing.bodies.position[i];
    if (packing.cell) r += packing.cell->offset(link.shift);
    const auto f = link_frame(r[0], r[1], packing.bodies.radius[i], packing.bodies.radius[j]);
    const LinkTangent respond{f,
                              packing.bodies.radius[i],
                              packing.bodies.radius[j],
                              link.normal_force,
                              link.tangential_force,
                              link.moment,
                              k[l].normal,
                              k[l].tangential,
                              k[l].moment};
    const double fx = link.normal_force * f.nx - link.tangential_force * f.ny,
                 fy = link.normal_force * f.ny + link.tangential_force * f.nx;
    stress_now[0] += fx * r[0], stress_now[1] += fy * r[1], stress_now[2] += 0.5 * (fx * r[1] + fy * r[0]);

    const auto unknown_of = [&](std::size_t body, std::int32_t d) {
      return d < per_body ? unknown[body * static_cast<std::size_t>(per_body) + static_cast<std::size_t>(d)] : -1;
    };
    // Body forces of a response, as columns of -d(body forces)/d(motion).
    const auto spread = [&](const LinkTangent::Response& q, auto&& put) {
      put(unknown_of(j, 0), -q.fx), put(unknown_of(j, 1), -q.fy), put(unknown_of(j, 2), -q.moment_j);
      put(unknown_of(i, 0), q.fx), put(unknown_of(i, 1), q.fy), put(unknown_of(i, 2), -q.moment_i);
    };
    const auto virial = [&](const LinkTangent::Response& q, double dx, double dy) {
      return std::array<double, 3>{q.fx * r[0] + fx * dx, q.fy * r[1] + fy * dy,
                                   0.5 * (q.fx * r[1] + fx * dy + q.fy * r[0] + fy * dx)};
    };
    struct Motion {
      std::int32_t column;
      double dx, dy, spin_i, spin_j;
    };
    const Motion motions[] = {{unknown_of(i, 0), -1, 0, 0, 0}, {unknown_of(i, 1), 0, -1, 0, 0},
                              {unknown_of(i, 2), 0, 0, 1, 0},  {unknown_of(j, 0), 1, 0, 0, 0},
                              {unknown_of(j, 1), 0, 1, 0, 0},  {unknown_of(j, 2), 0, 0, 0, 1}};
    for (const Motion& m : motions) {
      if (m.column < 0) continue;
      const auto q = respond(m.dx, m.dy, m.spin_i, m.spin_j);
      spread(q, [&](std::int32_t row, double v) { tangent.add(row, m.column, v); });
      const auto w = virial(q, m.dx, m.dy);
      for (std::size_t a = 0; a < 3; ++a) stress_of[a][static_cast<std::size_t>(m.column)] += w[a];
    }
    const std::array<Vec2, 3> affine = {Vec2{{-r[0], 0}}, Vec2{{0, -r[1]}}, Vec2{{-0.5 * r[1], -0.5 * r[0]}}};
    for (std::size_t b = 0; b < 3; ++b) {
      const auto q = respond(affine[b][0], affine[b][1], 0, 0);
      spread(q, [&](std::int32_t row, double v) {
        if (row >= 0) load[b][static_cast<std::size_t>(row)] -= v;
      });
      const auto w = virial(q, affine[b][0], affine[b][1]);
      for (std::size_t a = 0; a < 3; ++a) direct[a][b] += w[a];
    }
  }

  TangentModuli result;
  const auto relaxed = solve_unsymmetric(size, tangent, load);
  const double area = packing.cell->measure();
  for (std::size_t b = 0; b < 3; ++b)
    for (std::size_t a = 0; a < 3; ++a) {
      double sum = direct[a][b];
      for (std::size_t c = 0; c < static_cast<std::size_t>(size); ++c) sum += stress_of[a][c] * relaxed[b][c];
      if (b < 2) sum += stress_now[a];  // the area shrinks by the strain: sigma = virial / A
      result.tensor[a][b] = sum / area;
    }
  result.antisymmetric_part = antisymmetric_ratio(size, tangent);
  return result;
}

}  // namespace isostat
