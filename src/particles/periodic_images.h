// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "exec/launch.h"
#include "particles/columns.h"

#include <algorithm>
#include <array>
#include <initializer_list>

namespace brisance {

template <class T>
struct ImageKernel {
    T* arrays[10];
    int count, pad;
    const Column* columns;
    BRISANCE_HD void operator()(std::int64_t c) const {
        const int n = columns[c].layers;
        for (int a = 0; a < count; ++a) {
            T* first = arrays[a] + columns[c].start;
            // outwards, so that more images than layers repeat the pattern
            for (int k = 1; k <= pad; ++k) first[-k] = first[n - k];
            for (int k = 0; k < pad; ++k) first[n + k] = first[k];
        }
    }
};

/// Copies the layers of every column into its periodic images, for up to ten arrays at once.
template <class T>
void fill_images(const Columns& layout, std::initializer_list<T*> arrays) {
    if (!layout.periodic) return;
    ImageKernel<T> k{{}, static_cast<int>(arrays.size()), layout.pad, layout.columns.data()};
    std::copy(arrays.begin(), arrays.end(), k.arrays);
    exec::launch(static_cast<std::int64_t>(layout.columns.size()), k, 256);
}
template <class R>
void fill_images(const Columns& layout, std::array<Array<R>, 3>& a) {
    fill_images(layout, {a[0].data(), a[1].data(), a[2].data()});
}

}  // namespace brisance
