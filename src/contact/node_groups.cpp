// SPDX-License-Identifier: Apache-2.0
#include "contact/node_groups.h"

#include "exec/launch.h"

namespace brisance {

void NodeGroups::build(const double* x, const double* y, const double* z, std::int64_t n, double cell) {
    grid_.build(x, y, z, n, cell, 0);
    const CellGridView& grid = grid_.view();
    make_room(begin_, static_cast<std::size_t>(n) + 1);
    const std::int64_t* const from = grid.begin;
    std::int64_t* const to = begin_.data();
    const std::int64_t groups = exec::select(grid.beginnings - 1, BRISANCE_KERNEL(std::int64_t c) { return from[c] < from[c + 1]; },
                                             BRISANCE_KERNEL(std::int64_t c, std::int64_t g) { to[g] = from[c]; });
    exec::launch(1, BRISANCE_KERNEL(std::int64_t) { to[groups] = n; });
    size_ = groups;
}

}  // namespace brisance
