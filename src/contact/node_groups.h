// SPDX-License-Identifier: Apache-2.0
// Points in groups that stand together: what is near is looked for once for all of a group.
#pragma once

#include "neighbours/cell_grid.h"

namespace brisance {

/// Groups as kernels take them.
struct NodeGroupsView {
    const std::int64_t* begin;    ///< of each group, and the end of the last
    const std::int32_t* order;    ///< the points group by group; null: they stand in their own order
    std::int64_t size;

    /// f(i) for each point of group g.
    template <class F>
    BRISANCE_HD void each(std::int64_t g, F&& f) const {
        for (std::int64_t k = begin[g]; k < begin[g + 1]; ++k) f(order ? std::int64_t{order[k]} : k);
    }
};

/// The points of each cell of a grid.
class NodeGroups {
public:
    void build(const double* x, const double* y, const double* z, std::int64_t n, double cell);
    NodeGroupsView view() const { return {begin_.data(), grid_.view().index, size_}; }

private:
    CellGrid grid_;
    Array<std::int64_t> begin_;
    std::int64_t size_ = 0;
};

}  // namespace brisance
