#include "analysis/rigidity/rigid_bodies.hpp"

#include <limits>
#include <numeric>
#include <utility>

#include "analysis/rigidity/field_geometry.hpp"
#include "analysis/rigidity/link_rows.hpp"
#include "geometry/placed_sets.hpp"

namespace isostat {
namespace {

using F = FirstField;
using Point = FieldVec<F>;
using Shift = ImageShift<2>;

Shift operator+(const Shift& a, const Shift& b) { return {a[0] + b[0], a[1] + b[1]}; }
Shift operator-(const Shift& a, const Shift& b) { return {a[0] - b[0], a[1] - b[1]}; }
constexpr Shift kHome{};

// Pins between bodies, found by (body, body, image). Entries of absorbed bodies go stale and are never asked for.
class PinTable {
 public:
  explicit PinTable(std::size_t expected) {
    std::size_t capacity = 64;
    while (capacity < 2 * expected) capacity *= 2;
    slots_.resize(capacity);
  }

  // Pin-end on the side of a, or -1.
  int find(int a, int b, Shift image) const {
    const bool flip = canonical(a, b, image);
    for (std::size_t at = hash(a, b, image) & (slots_.size() - 1);; at = (at + 1) & (slots_.size() - 1)) {
      const Slot& s = slots_[at];
      if (s.end < 0) return -1;
      if (s.a == a && s.b == b && s.image == image) return flip ? s.end ^ 1 : s.end;
    }
  }
  void insert(int a, int b, Shift image, int end) {
    if (2 * (used_ + 1) > slots_.size()) grow();
    const bool flip = canonical(a, b, image);
    place({a, b, image, flip ? end ^ 1 : end});
    ++used_;
  }

 private:
  struct Slot {
    int a = 0, b = 0;
    Shift image{};
    int end = -1;
  };
  static bool canonical(int& a, int& b, Shift& image) {
    if (a < b) return false;
    std::swap(a, b);
    image = kHome - image;
    return true;
  }
  static std::size_t hash(int a, int b, const Shift& s) {
    std::uint64_t h = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(a)) << 32) | static_cast<std::uint32_t>(b);
    h ^= static_cast<std::uint64_t>(s[0]) * 0x9E3779B97F4A7C15ull +
         static_cast<std::uint64_t>(s[1]) * 0xC2B2AE3D27D4EB4Full;
    h = (h ^ (h >> 31)) * 0xBF58476D1CE4E5B9ull;
    return static_cast<std::size_t>(h ^ (h >> 29));
  }
  void place(const Slot& slot) {
    std::size_t at = hash(slot.a, slot.b, slot.image) & (slots_.size() - 1);
    while (slots_[at].end >= 0) at = (at + 1) & (slots_.size() - 1);
    slots_[at] = slot;
  }
  void grow() {
    std::vector<Slot> old(slots_.size() * 2);
    old.swap(slots_);
    for (const Slot& s : old)
      if (s.end >= 0) place(s);
  }
  std::vector<Slot> slots_;
  std::size_t used_ = 0;
};

// Pin-end e = 2 * pin + side: side 0 stands on the link's body i, side 1 on j; e ^ 1 is the other end.
class Contraction {
 public:
  Contraction(const LinkNetwork& network, NetworkLaw law)
      : packing_(network.packing),
        free_(network.free),
        geometry_(exact_geometry<F>(network)),
        sets_(network.packing.bodies.size()),
        table_(network.packing.links.size()) {
    const Packing<2>& packing = network.packing;
    const std::size_t n = packing.bodies.size();
    head_.assign(n, -1), tail_.assign(n, -1), degree_.assign(n, 0);
    for (std::size_t l = 0; l < packing.links.size(); ++l) {
      const Link<2>& link = packing.links[l];
      const LinkRows rows = rows_of(link.kind, law);
      if (rows.tangential && rows.rolling)
        glue(link);
      else if (rows.tangential)
        pin_link_.push_back(static_cast<std::int32_t>(l));
    }
    locate_pins();
    next_.assign(2 * pin_link_.size(), -1);
    for (int p = 0; p < static_cast<int>(pin_link_.size()); ++p) {
      append(2 * p), append(2 * p + 1);
      add_pin(2 * p);
      merge_pending();
    }
  }

  RigidBodies result() {
    RigidBodies bodies;
    const std::size_t n = packing_.bodies.size();
    bodies.body_of.resize(n), bodies.placement.resize(n);
    constexpr std::int32_t fresh = -2;
    std::vector<std::int32_t> number(n, fresh);
    for (std::size_t i = idx(free_); i < n; ++i) number[u(sets_.find(static_cast<int>(i)).root)] = RigidBodies::held;
    for (std::size_t i = 0; i < n; ++i) {
      const auto [root, image] = sets_.find(static_cast<int>(i));
      if (number[u(root)] == fresh) number[u(root)] = bodies.count++;
      bodies.body_of[i] = number[u(root)];
      bodies.placement[i] = image;
    }
    return bodies;
  }

 private:
  static std::size_t u(int i) { return static_cast<std::size_t>(i); }

  void glue(const Link<2>& link) {
    const auto [a, image_a] = sets_.find(link.i);
    const auto [b, image_b] = sets_.find(link.j);
    if (a != b) sets_.absorb(a, b, link.shift + image_a - image_b);  // another image of itself: left to the rows
  }

  // Contact points r_i + r_ij R_i / (R_i + R_j), all inverses by one (running products).
  void locate_pins() {
    const std::size_t n = pin_link_.size();
    point_.resize(n);
    std::vector<F> before(n);
    F product(1);
    const auto sum = [&](std::size_t p) {
      const Link<2>& link = pin(p);
      return geometry_.radius[u(link.i)] + geometry_.radius[u(link.j)];
    };
    for (std::size_t p = 0; p < n; ++p) {
      before[p] = product;
      const F s = sum(p);
      if (!s.is_zero()) product = product * s;
    }
    F inverse = product.inverse();
    for (std::size_t p = n; p-- > 0;) {
      const F s = sum(p);
      const Link<2>& link = pin(p);
      if (s.is_zero()) {  // p divides the sum: this pin takes no part
        point_[p] = {};
        unusable_.push_back(static_cast<int>(p));
        continue;
      }
      const F ratio = geometry_.radius[u(link.i)] * inverse * before[p];
      inverse = inverse * s;
      const Point r = geometry_.branch(link);
      const Point& centre = geometry_.position[u(link.i)];
      point_[p] = {centre[0] + r[0] * ratio, centre[1] + r[1] * ratio};
    }
  }

  const Link<2>& pin(std::size_t p) const { return packing_.links[static_cast<std::size_t>(pin_link_[p])]; }
  int grain(int end) const {
    const Link<2>& link = pin(u(end >> 1));
    return (end & 1) ? link.j : link.i;
  }

  // The pin point in the frame of the body that holds this end.
  Point point(int end) {
    const Shift a = sets_.find(grain(end)).image;
    const Shift raw = (end & 1) ? a - pin(u(end >> 1)).shift : a;
    const Point& c = point_[u(end >> 1)];
    if (raw == kHome) return c;
    const Point o = geometry_.offset(raw);
    return {c[0] + o[0], c[1] + o[1]};
  }

  struct Neighbour {
    int body;
    Shift image;  // of that body, seen from the frame of this end's body
  };
  Neighbour neighbour(int end) {
    const auto [a, image_a] = sets_.find(grain(end));
    const auto [b, image_b] = sets_.find(grain(end ^ 1));
    const Shift s = pin(u(end >> 1)).shift;
    return {b, ((end & 1) ? kHome - s : s) + image_a - image_b};
  }

  void append(int end) {
    const int a = sets_.find(grain(end)).root;
    if (head_[u(a)] < 0)
      head_[u(a)] = end;
    else
      next_[u(tail_[u(a)])] = end;
    tail_[u(a)] = end;
    next_[u(end)] = -1;
    ++degree_[u(a)];
  }

  // A pin between the body of this end and its neighbour has come into being: what does it make rigid?
  void add_pin(int end) {
    if (!unusable_.empty() && unusable(end >> 1)) return;
    const int a = sets_.find(grain(end)).root;
    const auto [c, image_c] = neighbour(end);
    if (a == c) return;
    const Point here = point(end);
    if (const int other = table_.find(a, c, image_c); other >= 0) {
      if (!(point(other) == here)) pending_.push_back({a, c, image_c});
      return;  // a coincident second pin adds nothing
    }
    table_.insert(a, c, image_c, end);

    const bool from_a = degree_[u(a)] <= degree_[u(c)];
    const Point shift = geometry_.offset(image_c);
    for (int f = head_[u(from_a ? a : c)]; f >= 0; f = next_[u(f)]) {
      const auto [d, image] = neighbour(f);
      if (d == a || d == c) continue;
      const Shift of_a = from_a ? image : image_c + image, of_c = from_a ? image - image_c : image;
      const int g = from_a ? table_.find(c, d, of_c) : table_.find(a, d, of_a);
      if (g < 0) continue;
      const Point on_a = point(from_a ? f : g);
      Point on_c = point(from_a ? g : f);
      on_c = {on_c[0] + shift[0], on_c[1] + shift[1]};
      const F cross = (on_a[0] - here[0]) * (on_c[1] - here[1]) - (on_a[1] - here[1]) * (on_c[0] - here[0]);
      if (cross.is_zero()) continue;
      pending_.push_back({a, c, image_c});
      pending_.push_back({a, d, of_a});
    }
  }

  bool unusable(int p) const {
    for (int q : unusable_)
      if (q == p) return true;
    return false;
  }

  void merge_pending() {
    while (!pending_.empty()) {
      auto [first, second, image] = pending_.back();
      pending_.pop_back();
      auto [a, image_a] = sets_.find(first);
      auto [b, image_b] = sets_.find(second);
      if (a == b) continue;
      Shift s = image + image_a - image_b;
      if (degree_[u(a)] < degree_[u(b)]) std::swap(a, b), s = kHome - s;
      const int moved = head_[u(b)];
      sets_.absorb(a, b, s);
      // The ends of the smaller list move over and meet their neighbours as pins of the merged body.
      for (int e = moved; e >= 0;) {
        const int next = next_[u(e)];
        if (neighbour(e).body != a) {
          append(e);
          add_pin(e);
        }
        e = next;
      }
    }
  }

  struct Merge {
    int first, second;
    Shift image;
  };
  const Packing<2>& packing_;
  std::int32_t free_;
  FieldGeometry<F> geometry_;
  PlacedSets<2> sets_;
  PinTable table_;
  std::vector<std::int32_t> pin_link_;
  std::vector<Point> point_;  // pin point in the raw frame of the link's grain i
  std::vector<int> unusable_;
  std::vector<int> head_, tail_, next_, degree_;  // lists of pin-ends by body
  std::vector<Merge> pending_;
};

}  // namespace

RigidBodies contract_rigid_bodies(const LinkNetwork& network, NetworkLaw law) {
  const Packing<2>& packing = network.packing;
  if (law == NetworkLaw::frictionless && packing.beams.empty() && !network.any_held()) {
    RigidBodies bodies;
    bodies.count = static_cast<std::int32_t>(packing.bodies.size());
    bodies.body_of.resize(packing.bodies.size());
    std::iota(bodies.body_of.begin(), bodies.body_of.end(), 0);
    bodies.placement.assign(packing.bodies.size(), kHome);
    return bodies;
  }
  return Contraction(network, law).result();
}

}  // namespace isostat
