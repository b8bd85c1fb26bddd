#include "analysis/figure/packing_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "analysis/figure/nice_numbers.hpp"

namespace isostat {
namespace {

constexpr double kMargin = 12;         // [pt] around the page
constexpr double kHairline = 0.05;     // [mean diameter] least width of blue lines, which tell a kind and not a force
constexpr double kPaleCluster = 0.6;   // share of white in the colour of an isostatic cluster
constexpr double kSmallestPage = 360;  // [pt] room for the legend

// Largest reach of the arrows beyond the disks, if the rms speed is drawn as one mean diameter.
double arrow_reach(const Bodies<2>& b) {
  double square = 0, largest = 0, diameter = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    square += dot(b.velocity[i], b.velocity[i]), largest = std::max(largest, norm(b.velocity[i]));
    diameter += 2 * b.radius[i];
  }
  const auto n = static_cast<double>(b.size());
  return square > 0 ? std::max(0.0, diameter / n * (largest / std::sqrt(square / n) - 0.5)) : 0;
}

double clamp_text(double longer_edge) { return std::clamp(longer_edge / 62, 8.5, 20.0); }

RichText with_unit(double x, const RichText& unit) {
  return unit.empty() ? number_text(x) : number_text(x) + plain("\u2009") + unit;
}

}  // namespace

PackingPicture::PackingPicture(const Packing<2>& packing, PictureOptions options)
    : packing_(packing),
      options_(std::move(options)),
      frame_(packing, options_.kind == PictureKind::velocity ? arrow_reach(packing.bodies) : 0) {
  for (const double r : packing.bodies.radius) largest_diameter_ = std::max(largest_diameter_, 2 * r);
  if (options_.kind == PictureKind::forces)
    shade_ = disk_shades(packing, options_.convention, options_.rattler);
  else
    shade_.assign(packing.bodies.size(), DiskShade::plain);

  const Rect box = frame_.box();
  text_size_ = clamp_text(std::max(box.width, box.height));
  if (options_.kind == PictureKind::velocity) choose_motion_scales();
  const double width = std::max(box.width, kSmallestPage);
  frame_.place({{kMargin + (width - box.width) / 2, kMargin}});
  legend_.emplace_back(legend_items(), text_size_, width);
  legend_place_ = {{kMargin, kMargin + box.height + 0.5 * text_size_}};
  size_ = {{width + 2 * kMargin, legend_place_[1] + legend_[0].height() + 0.5 * kMargin}};
}

double PackingPicture::force_width(double force) const {
  return options_.width_at_scale * largest_diameter_ * frame_.scale() * force / options_.force_scale;
}

double PackingPicture::outline_width() const {
  return std::clamp(0.04 * frame_.mean_diameter() * frame_.scale(), 0.15, 0.8);
}

void PackingPicture::draw(Canvas& canvas) const {
  if (frame_.periodic()) canvas.clip(frame_.box());
  canvas.begin_group("disks");
  draw_disks(canvas);
  canvas.end_group();
  canvas.begin_group("links");
  if (options_.kind == PictureKind::grains || options_.kind == PictureKind::clusters) draw_links(canvas);
  if (options_.kind == PictureKind::forces) draw_forces(canvas);
  canvas.end_group();
  if (options_.kind == PictureKind::velocity) {
    canvas.begin_group("velocities");
    draw_arrows(canvas);
    canvas.end_group();
  }
  if (frame_.periodic()) {
    canvas.unclip();
    canvas.begin_group("cell");
    canvas.rectangle(frame_.box(), {std::nullopt, Stroke{kInk, 0.9, {}}});
    canvas.end_group();
  }
  canvas.begin_group("legend");
  legend_[0].draw(canvas, legend_place_);
  canvas.end_group();
}

// One batch a colour; every image that shows in the cell.
void PackingPicture::draw_disks(Canvas& canvas) const {
  constexpr int kSpinSteps = 32;  // shades on each side of zero
  const Bodies<2>& b = packing_.bodies;
  const bool velocity = options_.kind == PictureKind::velocity;
  const bool clusters = options_.kind == PictureKind::clusters;
  // clusters: batch 0 in none, then by colour, isostatic before hyperstatic
  std::vector<std::vector<DiskMark>> batches(velocity ? 2 * kSpinSteps + 1 : clusters ? 1 + 2 * kCurves.size() : 3);
  for (std::size_t i = 0; i < b.size(); ++i) {
    std::size_t batch = static_cast<std::size_t>(shade_[i]);
    if (velocity) {
      const double t = reference_spin_ > 0 ? std::clamp(b.spin[i] / reference_spin_, -1.0, 1.0) : 0;
      batch = static_cast<std::size_t>(std::lround(kSpinSteps * (t + 1)));
    }
    if (clusters && options_.cluster_of_grain[i] >= 0) {
      const auto c = static_cast<std::size_t>(options_.cluster_of_grain[i]);
      batch = 1 + c % kCurves.size() + (options_.hyperstatic[c] ? kCurves.size() : 0);
    }
    const Vec2 r = frame_.wrap(b.position[i]), reach{{b.radius[i], b.radius[i]}};
    frame_.for_visible_images(r - reach, r + reach, [&](const Vec2& offset) {
      batches[batch].push_back({frame_.page(r + offset), b.radius[i] * frame_.scale()});
    });
  }
  // a faint outline for small disks, or it is all that one sees
  const bool small = frame_.mean_diameter() * frame_.scale() < 6;
  const Stroke outline{small ? blend(kDiskOutline, kWhite, 0.55) : kDiskOutline, outline_width(), {}};
  for (std::size_t k = 0; k < batches.size(); ++k) {
    Paint paint{kGrain, Stroke{kGrainOutline, outline.width, {}}};
    if (options_.kind == PictureKind::forces) paint = {std::array{kDisk, kRattler, kUnstressed}[k], outline};
    if (clusters) {
      const Color strong = k > 0 ? curve_color((k - 1) % kCurves.size()) : kDisk;
      paint = {k > 0 && k <= kCurves.size() ? blend(strong, kWhite, kPaleCluster) : strong, outline};
    }
    if (velocity) paint = {diverging(static_cast<double>(k) / kSpinSteps - 1), outline};
    canvas.disks(batches[k], paint);
  }
}

void PackingPicture::segments(Canvas& canvas, const std::vector<std::pair<const Link<2>*, double>>& links,
                              const Color& color) const {
  std::vector<SegmentMark> marks;
  for (const auto& [link, width] : links) {
    const Vec2 from = frame_.wrap(packing_.bodies.position[static_cast<std::size_t>(link->i)]);
    const Vec2 to = from + frame_.branch(packing_, *link);
    const double half = width / (2 * frame_.scale());
    Vec2 low, high;
    for (int k = 0; k < 2; ++k) low[k] = std::min(from[k], to[k]) - half, high[k] = std::max(from[k], to[k]) + half;
    frame_.for_visible_images(low, high, [&](const Vec2& offset) {
      marks.push_back({frame_.page(from + offset), frame_.page(to + offset), width});
    });
  }
  canvas.segments(marks, color);
}

void PackingPicture::draw_links(Canvas& canvas) const {
  const double width = std::clamp(0.06 * frame_.mean_diameter() * frame_.scale(), 0.2, 2.0);
  std::vector<std::pair<const Link<2>*, double>> closed, distant;
  for (std::size_t l = 0; l < packing_.links.size(); ++l) {
    const Link<2>& link = packing_.links[l];
    const bool blue =
        options_.kind == PictureKind::clusters ? options_.cluster_of_link[l] < 0 : link.kind == LinkKind::distant;
    (blue ? distant : closed).emplace_back(&link, width);
  }
  segments(canvas, distant, kDistant);
  segments(canvas, closed, kInk);
}

// Blue below, then thin before thick, so that the strong chains are on top.
void PackingPicture::draw_forces(Canvas& canvas) const {
  const double hairline = std::min(kHairline * frame_.mean_diameter() * frame_.scale(), 0.6);  // [pt]
  std::array<std::vector<std::pair<const Link<2>*, double>>, 3> by_color;
  for (const Link<2>& link : packing_.links) {
    const LinkColor color = link_color(link, options_.convention);
    double width = force_width(drawn_force(link, options_.convention));
    if (color == LinkColor::distant) width = std::max(width, hairline);
    by_color[static_cast<std::size_t>(color)].emplace_back(&link, width);
  }
  for (auto& links : by_color)
    std::stable_sort(links.begin(), links.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  segments(canvas, by_color[static_cast<std::size_t>(LinkColor::distant)], kDistant);
  segments(canvas, by_color[static_cast<std::size_t>(LinkColor::tensile)], kTensile);
  segments(canvas, by_color[static_cast<std::size_t>(LinkColor::compressive)], kCompressive);
}

// An arrow for the rms speed is one mean diameter long; the colour bar ends at the 95th percentile of |spin|.
void PackingPicture::choose_motion_scales() {
  const Bodies<2>& b = packing_.bodies;
  double square = 0;
  for (const Vec2& v : b.velocity) square += dot(v, v);
  const double rms = std::sqrt(square / static_cast<double>(b.size()));
  if (rms > 0) {
    arrow_scale_ = frame_.mean_diameter() * frame_.scale() / rms;
    reference_speed_ = nice_below(std::min(1.5 * rms, 4 * text_size_ / arrow_scale_));
  }
  std::vector<double> spin;
  for (const double w : b.spin) spin.push_back(std::abs(w));
  const auto rank = spin.begin() + static_cast<std::ptrdiff_t>(0.95 * static_cast<double>(spin.size() - 1));
  std::nth_element(spin.begin(), rank, spin.end());
  double limit = *rank;
  if (limit == 0) limit = *std::max_element(spin.begin(), spin.end());
  if (limit > 0) reference_spin_ = nice_above(limit);
}

namespace {

// Tail at `tail`, along d [pt]; seven corners.
Polygon arrow(const Vec2& tail, const Vec2& d, double shaft) {
  const double length = norm(d), head = std::min(0.45 * length, 5 * shaft), wing = 0.5 * head;
  const Vec2 u = (1 / length) * d, n{{-u[1], u[0]}};
  const Vec2 neck = tail + (length - head) * u;
  const double h = 0.5 * std::min(shaft, 0.5 * wing * 2);
  return {tail + h * n, neck + h * n, neck + wing * n, tail + d, neck - wing * n, neck - h * n, tail - h * n};
}

}  // namespace

void PackingPicture::draw_arrows(Canvas& canvas) const {
  constexpr double kShortest = 0.3;  // [pt] below it nothing would be seen
  const Bodies<2>& b = packing_.bodies;
  const double shaft = std::clamp(0.08 * frame_.mean_diameter() * frame_.scale(), 0.3, 2.5);
  std::vector<Polygon> arrows;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const Vec2 d{{arrow_scale_ * b.velocity[i][0], -arrow_scale_ * b.velocity[i][1]}};
    if (norm(d) < kShortest) continue;
    const Vec2 r = frame_.wrap(b.position[i]), tip = r + Vec2{{d[0] / frame_.scale(), -d[1] / frame_.scale()}};
    const double reach = 3 * shaft / frame_.scale();
    Vec2 low, high;
    for (int k = 0; k < 2; ++k) low[k] = std::min(r[k], tip[k]) - reach, high[k] = std::max(r[k], tip[k]) + reach;
    frame_.for_visible_images(low, high,
                              [&](const Vec2& offset) { arrows.push_back(arrow(frame_.page(r + offset), d, shaft)); });
  }
  canvas.polygons(arrows, {kInk, std::nullopt});
}

std::vector<LegendItem> PackingPicture::legend_items() const {
  const double em = text_size_;
  std::vector<LegendItem> items;
  if (options_.kind == PictureKind::grains) {
    bool closed = false, distant = false;
    for (const Link<2>& link : packing_.links) (link.kind == LinkKind::distant ? distant : closed) = true;
    if (closed && distant) items.push_back(line_item(em, kInk, plain("contact")));
    if (distant) items.push_back(line_item(em, kDistant, plain("distant")));
  }
  if (options_.kind == PictureKind::clusters) {
    const Stroke outline{kDiskOutline, std::max(outline_width(), 0.4), {}};
    bool strong = false, pale = false, hinge = false;
    for (const bool h : options_.hyperstatic) (h ? strong : pale) = true;
    for (const std::int32_t c : options_.cluster_of_link) hinge = hinge || c < 0;
    if (strong) items.push_back(disk_item(em, {curve_color(0), outline}, plain("hyperstatic cluster")));
    if (pale)
      items.push_back(
          disk_item(em, {blend(curve_color(0), kWhite, kPaleCluster), outline}, plain("isostatic cluster")));
    const auto& cluster = options_.cluster_of_grain;
    if (std::find(cluster.begin(), cluster.end(), -1) != cluster.end())
      items.push_back(disk_item(em, {kDisk, outline}, plain("single")));
    if (hinge) items.push_back(line_item(em, kDistant, plain("hinge")));
  }
  if (options_.kind == PictureKind::forces) {
    std::array<bool, 3> color{}, shade{};
    for (const Link<2>& link : packing_.links)
      color[static_cast<std::size_t>(link_color(link, options_.convention))] = true;
    for (const DiskShade s : shade_) shade[static_cast<std::size_t>(s)] = true;
    const auto& threshold = options_.convention.threshold;
    if (color[0]) items.push_back(line_item(em, kCompressive, plain("compressive")));
    if (color[1]) items.push_back(line_item(em, kTensile, plain("tensile")));
    if (color[2])
      items.push_back(line_item(
          em, kDistant,
          threshold ? rich("|`F`| < ") +
                          with_unit(*threshold, options_.force_scale == 1 ? options_.force_scale_label : RichText{})
                    : plain("distant")));
    const Stroke outline{kDiskOutline, std::max(outline_width(), 0.4), {}};
    if (shade[1]) items.push_back(disk_item(em, {kRattler, outline}, plain("rattler")));
    if (shade[2]) items.push_back(disk_item(em, {kUnstressed, outline}, plain("unstressed")));
    // a bar not thicker than the text is high
    double force = options_.force_scale;
    RichText name = options_.force_scale_label;
    if (force_width(force) > em || name.empty()) {
      const double fraction = nice_below(std::min(1.0, em / force_width(force)));
      force = name.empty() ? nice_below(fraction * force) : fraction * force;
      name = with_unit(name.empty() ? force : fraction, name);
    }
    const char* measure = options_.convention.width == ForceMeasure::total ? "|`F`| = " : "|`N`| = ";
    items.push_back(force_scale_item(force_width(force), em, rich(measure) + name));
  }
  if (options_.kind == PictureKind::velocity) {
    if (reference_speed_ > 0) {
      const double length = arrow_scale_ * reference_speed_, shaft = std::clamp(0.09 * length, 0.6, 2.5);
      items.push_back({length,
                       [=](Canvas& canvas, const Vec2& p) {
                         const Polygon mark = arrow(p, {{length, 0}}, shaft);
                         canvas.polygons({&mark, 1}, {kInk, std::nullopt});
                       },
                       options_.speed_symbol + plain(" = ") + with_unit(reference_speed_, options_.speed_unit)});
    } else {
      items.push_back(text_item(plain("at rest")));
    }
    if (reference_spin_ > 0)
      items.push_back(color_bar_item(em, diverging, plain("spin  ") + number_text(-reference_spin_),
                                     with_unit(reference_spin_, options_.spin_unit)));
  }
  const double bar = nice_below(std::max(0.16 * frame_.box().width, 36.0) / frame_.scale());
  items.push_back(length_scale_item(bar * frame_.scale(), with_unit(bar, options_.length_unit)));
  return items;
}

}  // namespace isostat
