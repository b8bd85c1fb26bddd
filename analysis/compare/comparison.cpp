#include "analysis/compare/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "dem/files/formats/real_text.hpp"
#include "dem/state/solid_fraction.hpp"
#include "geometry/base/index.hpp"

namespace isostat {
namespace {

using Json = nlohmann::ordered_json;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(); }

template <int D>
Json cell_json(const Packing<D>& before, const Packing<D>& after) {
  if (!before.cell || !after.cell) return nullptr;
  Json strain = Json::array();
  for (int k = 0; k < D; ++k) strain.push_back(1 - after.cell->length[k] / before.cell->length[k]);
  const double shear = followed(*before.cell, *after.cell).slant() - before.cell->slant();
  return {{"strain", std::move(strain)},
          {"shear", shear},
          {"solid_fraction", {solid_fraction(before), solid_fraction(after)}}};
}

Json changes_json(const LinkChanges& c) {
  const std::size_t kept = c.kept_before.size();
  return {{"before", kept + c.lost.size()},
          {"after", kept + c.gained.size()},
          {"kept", kept},
          {"lost", c.lost.size()},
          {"gained", c.gained.size()}};
}

// Root mean square of the displacements that the strain alone gives to points spread evenly over the cell.
template <int D>
double affine_rms(const Packing<D>& before, const Packing<D>& after) {
  if (!before.cell || !after.cell) return NAN;
  double sum = 0;
  for (int k = 0; k < D; ++k) sum += std::pow(after.cell->length[k] - before.cell->length[k], 2) / 12;
  sum += std::pow(followed(*before.cell, *after.cell).tilt - before.cell->tilt, 2) / 12;
  return std::sqrt(sum);
}

template <int D>
Json displacement_json(const Packing<D>& before, const Packing<D>& after, const std::vector<Vec<D>>& u) {
  double sum = 0, largest = 0;
  for (const Vec<D>& one : u) sum += dot(one, one), largest = std::max(largest, norm(one));
  const double rms = std::sqrt(sum / static_cast<double>(u.size())), affine = affine_rms(before, after);
  return {{"nonaffine_rms", number(rms)},
          {"nonaffine_largest", largest},
          {"affine_rms", number(affine)},
          {"nonaffine_over_affine", affine > 0 ? number(rms / affine) : Json()}};
}

Json regions_json(const RigidRegions& found, std::size_t grains, double tolerance) {
  Json sizes = Json::array(), misfits = Json::array();
  for (const RigidRegion& r : found.regions) sizes.push_back(r.grains.size()), misfits.push_back(r.misfit);
  return {{"tolerance", tolerance},
          {"count", found.regions.size()},
          {"grains", found.grains_in_regions()},
          {"share_of_grains", static_cast<double>(found.grains_in_regions()) / static_cast<double>(grains)},
          {"mean_size_weighted", number(found.mean_size_weighted())},
          {"sizes", std::move(sizes)},
          {"misfit", std::move(misfits)}};
}

void append(std::string& line, double x) {
  line += ',';
  append_real(line, x);
}

}  // namespace

template <int D>
Comparison<D> compare(const Packing<D>& before, const Packing<D>& after, double tolerance) {
  Comparison<D> c;
  c.grains = match_grains(before, after);
  c.contacts = link_changes(before, after, c.grains, LinkFamily::contacts);
  c.distant = link_changes(before, after, c.grains, LinkFamily::distant);
  c.displacement = nonaffine_displacements(before, after, c.grains);
  c.regions = rigid_regions(before, after, c.grains, c.contacts, tolerance);
  return c;
}

template <int D>
Json comparison_json(const Packing<D>& before, const Packing<D>& after, const Comparison<D>& found, double tolerance) {
  return {{"grains", {{"before", count_free(before)}, {"after", count_free(after)}, {"matched", found.grains.size()}}},
          {"cell", cell_json(before, after)},
          {"contacts", changes_json(found.contacts)},
          {"distant", changes_json(found.distant)},
          {"displacement", displacement_json(before, after, found.displacement)},
          {"rigid_regions", regions_json(found.regions, found.grains.size(), tolerance)}};
}

template <int D>
std::string displacements_csv(const Packing<D>& after, const Comparison<D>& found) {
  std::string text = D == 2 ? "id,x,y,r,ux,uy,region\n" : "id,x,y,z,r,ux,uy,uz,region\n";
  for (std::size_t g = 0; g < found.grains.size(); ++g) {
    const std::size_t body = found.grains.after[g];
    text += std::to_string(after.bodies.id[body]);
    for (int k = 0; k < D; ++k) append(text, after.bodies.position[body][k]);
    append(text, after.bodies.radius[body]);
    for (int k = 0; k < D; ++k) append(text, found.displacement[g][k]);
    text += ',' + std::to_string(found.regions.of_grain[g]) + '\n';
  }
  return text;
}

template <int D>
std::string link_changes_csv(const Packing<D>& before, const Packing<D>& after, const Comparison<D>& found) {
  std::string text = "i,j,kind_before,kind_after,change,N_before,N_after,region\n";
  const auto line = [&text](const Packing<D>& of, const Link<D>& link, const Link<D>* was, const Link<D>* is,
                            const char* change, std::int32_t region) {
    text += std::to_string(of.bodies.id[idx(link.i)]) + ',' + std::to_string(of.bodies.id[idx(link.j)]);
    for (const Link<D>* one : {was, is}) text += ',' + (one ? std::string(letters(one->kind)) : std::string());
    text += ',' + std::string(change);
    for (const Link<D>* one : {was, is})
      if (one)
        append(text, one->normal_force);
      else
        text += ',';
    text += ',' + (region < 0 ? std::string() : std::to_string(region)) + '\n';
  };
  for (const LinkChanges* family : {&found.contacts, &found.distant}) {
    for (const std::size_t l : family->lost) line(before, before.links[l], &before.links[l], nullptr, "lost", -1);
    for (const std::size_t l : family->gained) line(after, after.links[l], nullptr, &after.links[l], "gained", -1);
    for (std::size_t k = 0; k < family->kept_before.size(); ++k) {
      const Link<D>& was = before.links[family->kept_before[k]];
      line(before, was, &was, &after.links[family->kept_after[k]], "kept",
           family == &found.contacts ? found.regions.of_kept_link[k] : -1);
    }
  }
  return text;
}

template Comparison<2> compare(const Packing<2>&, const Packing<2>&, double);
template Comparison<3> compare(const Packing<3>&, const Packing<3>&, double);
template Json comparison_json(const Packing<2>&, const Packing<2>&, const Comparison<2>&, double);
template Json comparison_json(const Packing<3>&, const Packing<3>&, const Comparison<3>&, double);
template std::string displacements_csv(const Packing<2>&, const Comparison<2>&);
template std::string displacements_csv(const Packing<3>&, const Comparison<3>&);
template std::string link_changes_csv(const Packing<2>&, const Packing<2>&, const Comparison<2>&);
template std::string link_changes_csv(const Packing<3>&, const Packing<3>&, const Comparison<3>&);

}  // namespace isostat
