// The full tangent with prestress (geometric term) and the moduli that follow from it.
#include "analysis/stiffness/area_tangent.hpp"
#include "analysis/stiffness/link_tangent.hpp"
#include "analysis/stiffness/moduli.hpp"

namespace isostat {
TangentModuli tangent_moduli(const LinkNetwork& network, NetworkLaw network_law, const DiskLaw& law) {
  const Packing<2>& packing = network.packing;
  const std::int32_t per_body = dof_layout(network, network_law, false).per_body;
  const auto count = packing.bodies.size();

  // Unknowns: bodies with links, the first of each connected piece held against translation.
  std::vector<std::int32_t> piece(count, -1), unknown(count * static_cast<std::size_t>(per_body), -1);
  std::vector<std::vector<std::int32_t>> neighbours(count);
  for (std::size_t l = 0; l < network.links(); ++l)
    network.each_bond(l, [&](std::int32_t i, std::int32_t j, const ImageShift<2>&) {
      neighbours[static_cast<std::size_t>(i)].push_back(j);
      neighbours[static_cast<std::size_t>(j)].push_back(i);
    });
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

  const std::vector<LinkTangent> tangents = link_tangents(network, network_law, law);
  Triplets entries;
  std::vector<std::vector<double>> load(3, std::vector<double>(static_cast<std::size_t>(size), 0.0));
  // stress[a] as a linear function of the unknowns, and its direct part from the strains.
  std::vector<std::vector<double>> stress_of(3, std::vector<double>(static_cast<std::size_t>(size), 0.0));
  Moduli direct{};
  std::array<double, 3> stress_now{};
  for (std::size_t l = 0; l < packing.links.size(); ++l) {
    const Link<2>& link = packing.links[l];
    const auto i = static_cast<std::size_t>(link.i), j = static_cast<std::size_t>(link.j);
    const LinkTangent& respond = tangents[l];
    const LinkFrame<double>& f = respond.f;
    const Vec2& r = respond.branch;
    const double fx = link.normal_force * f.nx - link.tangential_force * f.ny,
                 fy = link.normal_force * f.ny + link.tangential_force * f.nx;
    stress_now[0] += fx * r[0], stress_now[1] += fy * r[1], stress_now[2] += 0.5 * (fx * r[1] + fy * r[0]);

    const auto unknown_of = [&](int d) {  // -1: no spin, or held
      return d % 3 < per_body
                 ? unknown[(d < 3 ? i : j) * static_cast<std::size_t>(per_body) + static_cast<std::size_t>(d % 3)]
                 : -1;
    };
    const auto spread = [&](const LinkTangent::Response& q, auto&& put) {
      const std::array<double, 6> column = LinkTangent::resistance(q);
      for (int d = 0; d < 6; ++d)
        if (unknown_of(d) >= 0) put(unknown_of(d), column[static_cast<std::size_t>(d)]);
    };
    const auto virial = [&](const LinkTangent::Response& q, double dx, double dy) {
      return std::array<double, 3>{q.fx * r[0] + fx * dx, q.fy * r[1] + fy * dy,
                                   0.5 * (q.fx * r[1] + fx * dy + q.fy * r[0] + fy * dx)};
    };
    for (int d = 0; d < 6; ++d) {
      const std::int32_t column = unknown_of(d);
      if (column < 0) continue;
      const auto q = respond.to_dof(d);
      spread(q, [&](std::int32_t row, double v) { entries.add(row, column, v); });
      const double sign = d < 3 ? -1 : 1;
      const auto w = virial(q, d % 3 == 0 ? sign : 0, d % 3 == 1 ? sign : 0);
      for (std::size_t a = 0; a < 3; ++a) stress_of[a][static_cast<std::size_t>(column)] += w[a];
    }
    const std::array<Vec2, 3> affine = {Vec2{{-r[0], 0}}, Vec2{{0, -r[1]}}, Vec2{{-0.5 * r[1], -0.5 * r[0]}}};
    for (std::size_t b = 0; b < 3; ++b) {
      const auto q = respond(affine[b][0], affine[b][1], 0, 0);
      spread(q, [&](std::int32_t row, double v) { load[b][static_cast<std::size_t>(row)] -= v; });
      const auto w = virial(q, affine[b][0], affine[b][1]);
      for (std::size_t a = 0; a < 3; ++a) direct[a][b] += w[a];
    }
  }

  for (const AreaLink& area : network.areas) {
    const AreaTangent t = area_tangent(network, area);
    const auto unknown_of = [&](std::size_t d) {
      return unknown[static_cast<std::size_t>(t.place[d / 3].body) * 3 + d % 3];
    };
    std::vector<Vec2> at;  // of the triangles
    for (const auto& [body, shift] : t.place)
      at.push_back(packing.bodies.position[static_cast<std::size_t>(body)] + packing.cell->offset(shift));
    // Virial, summed over forces times positions, of the force f on the triangle of dof d.
    const auto add_virial = [&](std::array<double, 3>& w, std::size_t d, double f, const Vec2& x) {
      if (d % 3 == 0) w[0] += f * x[0], w[2] += 0.5 * f * x[1];
      if (d % 3 == 1) w[1] += f * x[1], w[2] += 0.5 * f * x[0];
    };
    // Response to a motion of the dofs.
    const auto virial = [&](const std::vector<double>& motion) {
      std::array<double, 3> w{};
      for (std::size_t d = 0; d < t.size(); ++d) {
        double change = 0;
        for (std::size_t c = 0; c < t.size(); ++c) change -= t.resistance[d * t.size() + c] * motion[c];
        add_virial(w, d, change, at[d / 3]);
        add_virial(w, d, t.load[d], {{motion[d - d % 3], motion[d - d % 3 + 1]}});
      }
      return w;
    };
    for (std::size_t d = 0; d < t.size(); ++d) add_virial(stress_now, d, t.load[d], at[d / 3]);
    for (std::size_t c = 0; c < t.size(); ++c) {
      const std::int32_t column = unknown_of(c);
      if (column < 0) continue;
      for (std::size_t r = 0; r < t.size(); ++r)
        if (unknown_of(r) >= 0) entries.add(unknown_of(r), column, t.resistance[r * t.size() + c]);
      std::vector<double> motion(t.size(), 0.0);
      motion[c] = 1;
      const auto w = virial(motion);
      for (std::size_t a = 0; a < 3; ++a) stress_of[a][static_cast<std::size_t>(column)] += w[a];
    }
    for (std::size_t b = 0; b < 3; ++b) {
      std::vector<double> motion(t.size(), 0.0);
      for (std::size_t k = 0; k < at.size(); ++k) {
        const std::array<Vec2, 3> affine = {Vec2{{-at[k][0], 0}}, Vec2{{0, -at[k][1]}},
                                            Vec2{{-0.5 * at[k][1], -0.5 * at[k][0]}}};
        motion[3 * k] = affine[b][0], motion[3 * k + 1] = affine[b][1];
      }
      for (std::size_t r = 0; r < t.size(); ++r) {
        if (unknown_of(r) < 0) continue;
        for (std::size_t c = 0; c < t.size(); ++c)
          load[b][static_cast<std::size_t>(unknown_of(r))] -= t.resistance[r * t.size() + c] * motion[c];
      }
      const auto w = virial(motion);
      for (std::size_t a = 0; a < 3; ++a) direct[a][b] += w[a];
    }
  }

  TangentModuli result;
  const UnsymmetricMatrix tangent = assemble(size, entries);
  const UnsymmetricLu factor(tangent);
  std::vector<std::vector<double>> relaxed;
  for (const auto& b : load) relaxed.push_back(factor.solve(b));
  const double area = packing.cell->measure();
  for (std::size_t b = 0; b < 3; ++b)
    for (std::size_t a = 0; a < 3; ++a) {
      double sum = direct[a][b];
      for (std::size_t c = 0; c < static_cast<std::size_t>(size); ++c) sum += stress_of[a][c] * relaxed[b][c];
      if (b < 2) sum += stress_now[a];  // the area shrinks by the strain: sigma = virial / A
      result.tensor[a][b] = sum / area;
    }
  result.antisymmetric_part = antisymmetric_part(tangent);
  return result;
}

}  // namespace isostat
