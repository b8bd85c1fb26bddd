// Grains and contacts as CSV (docs/formats.md): X.grains.csv and, beside it, X.contacts.csv.
#pragma once
#include <string>
#include <string_view>

#include "dem/state/packing.hpp"

namespace isostat {

// id,x,y,r,vx,vy,omega (3D id,x,y,z,r,vx,vy,vz,wx,wy,wz)
template <int D>
std::string grains_csv(const Packing<D>& packing);
// i,j,s1,s2,kind,h,N,T,M (3D i,j,s1,s2,s3,kind,h,N,Tx,Ty,Tz,Mx,My,Mz); i and j are ids
template <int D>
std::string contacts_csv(const Packing<D>& packing);

// "X.csv" or "X.grains.csv" -> "X.grains.csv", "X.contacts.csv".
std::string grains_csv_path(std::string_view path);
std::string contacts_csv_path(std::string_view path);

}  // namespace isostat
