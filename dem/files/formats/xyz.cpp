#include "dem/files/formats/xyz.hpp"

#include "dem/files/formats/real_text.hpp"

namespace isostat {
namespace {
void append(std::string& text, double value) { text += ' ', append_real(text, value); }
Vec3 spatial(double spin) { return {{0, 0, spin}}; }
Vec3 spatial(const Vec2& v) { return {{v[0], v[1], 0}}; }
Vec3 spatial(const Vec3& v) { return v; }
}  // namespace

template <int D>
std::string extended_xyz(const Packing<D>& packing, double time) {
  const Bodies<D>& b = packing.bodies;
  std::string text = std::to_string(packing.grains()) + "\n";
  if (packing.cell) {
    text += "Lattice=\"";
    for (int row = 0; row < 3; ++row)
      for (int col = 0; col < 3; ++col) {
        if (row + col > 0) text += ' ';
        append_real(text, row == 1 && col == 0 ? packing.cell->tilt
                          : row != col         ? 0.0
                          : row < D            ? packing.cell->length[row]
                                               : 1.0);
      }
    text += "\" ";
  }
  text += packing.cell ? (D == 2 ? "pbc=\"T T F\"" : "pbc=\"T T T\"") : "pbc=\"F F F\"";
  text += " Time=";
  append_real(text, time);
  text += " Properties=species:S:1:pos:R:3:id:I:1:radius:R:1:velo:R:3:angular_velocity:R:3:mass:R:1\n";
  for (std::size_t k = 0; k < packing.grains(); ++k) {
    text += "X";
    const auto vector = [&text](const Vec3& v) {
      for (int a = 0; a < 3; ++a) append(text, v[a]);
    };
    vector(spatial(b.position[k]));
    text += ' ' + std::to_string(b.id[k]);
    append(text, b.radius[k]);
    vector(spatial(b.velocity[k]));
    vector(spatial(b.spin[k]));
    append(text, b.mass[k]);
    text += '\n';
  }
  return text;
}

template std::string extended_xyz(const Packing<2>&, double);
template std::string extended_xyz(const Packing<3>&, double);

}  // namespace isostat
