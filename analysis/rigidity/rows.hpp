// Rows of G as blocks: a row is a short list of bodies, each with the load that a unit link force puts on it. The
// strain of the cell is one more body, numbered after the last; what is held (a wall, a driven body) is a block left
// out.
#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/rigidity/link_rows.hpp"

namespace isostat {

// Most: dofs of a body, 3 in the plane (Vx, Vy, W; of the strain e_1, e_2, nothing), 6 in space (V, W; of the strain
// e_1, e_2, e_3, nothing).
template <class F, int Most = 3>
struct RowBlock {
  std::int32_t body = 0;
  std::array<F, Most> at{};
};

template <class F, int Most = 3>
struct Rows {
  struct Row {
    std::uint32_t begin = 0;  // first block
    std::int32_t link = 0;    // of the network
    RowKind kind = RowKind::normal;
    std::int8_t axis = 0;  // in space, see link_rows_3d.hpp
  };
  std::vector<RowBlock<F, Most>> blocks;  // a body at most once in a row, the strain last
  std::vector<Row> rows;

  std::size_t size() const { return rows.size(); }
  std::span<const RowBlock<F, Most>> of(std::size_t row) const {
    const std::size_t begin = rows[row].begin, end = row + 1 < rows.size() ? rows[row + 1].begin : blocks.size();
    return {blocks.data() + begin, end - begin};
  }
  const std::array<F, Most>& at(std::size_t row, std::int32_t body) const {  // body takes part in the row
    const RowBlock<F, Most>* block = blocks.data() + rows[row].begin;
    while (block->body != body) ++block;
    return block->at;
  }
  void begin_row(std::int32_t link, RowKind kind, int axis = 0) {
    rows.push_back({static_cast<std::uint32_t>(blocks.size()), link, kind, static_cast<std::int8_t>(axis)});
  }
};

}  // namespace isostat
