#include "dem/files/formats/csv.hpp"

#include "dem/files/formats/real_text.hpp"
#include "dem/state/joins_grains.hpp"

namespace isostat {
namespace {

void append(std::string& text, double value) { text += ',', append_real(text, value); }
template <int D>
void append(std::string& text, const Vec<D>& v) {
  for (int k = 0; k < D; ++k) append(text, v[k]);
}

std::string_view stem(std::string_view path) {
  for (std::string_view end : {".grains.csv", ".csv"})
    if (path.ends_with(end)) return path.substr(0, path.size() - end.size());
  return path;
}

}  // namespace

template <int D>
std::string grains_csv(const Packing<D>& packing) {
  const Bodies<D>& b = packing.bodies;
  std::string text = D == 2 ? "id,x,y,r,vx,vy,omega\n" : "id,x,y,z,r,vx,vy,vz,wx,wy,wz\n";
  for (std::size_t k = 0; k < packing.grains(); ++k) {
    text += std::to_string(b.id[k]);
    append(text, b.position[k]);
    append(text, b.radius[k]);
    append(text, b.velocity[k]);
    append(text, b.spin[k]);
    text += '\n';
  }
  return text;
}

template <int D>
std::string contacts_csv(const Packing<D>& packing) {
  std::string text = D == 2 ? "i,j,s1,s2,kind,h,N,T,M\n" : "i,j,s1,s2,s3,kind,h,N,Tx,Ty,Tz,Mx,My,Mz\n";
  for (const Link<D>& l : packing.links) {
    if (!joins_grains(packing, l)) continue;
    text += std::to_string(packing.bodies.id[static_cast<std::size_t>(l.i)]) + ',' +
            std::to_string(packing.bodies.id[static_cast<std::size_t>(l.j)]);
    for (const int s : l.shift) text += ',' + std::to_string(s);
    text += ',';
    text += letters(l.kind);
    append(text, l.gap);
    append(text, l.normal_force);
    append(text, l.tangential_force);
    append(text, l.moment);
    text += '\n';
  }
  return text;
}

std::string grains_csv_path(std::string_view path) { return std::string(stem(path)) + ".grains.csv"; }
std::string contacts_csv_path(std::string_view path) { return std::string(stem(path)) + ".contacts.csv"; }

template std::string grains_csv(const Packing<2>&);
template std::string grains_csv(const Packing<3>&);
template std::string contacts_csv(const Packing<2>&);
template std::string contacts_csv(const Packing<3>&);

}  // namespace isostat
