// SPDX-License-Identifier: Apache-2.0
#include "particles/mirrored.h"

#include "exec/launch.h"

#include <algorithm>

namespace brisance {

namespace {

/// What the images are written to.
struct Room {
    double *place[3], *sign[3];
    std::int32_t* of;
    std::int64_t size;
};
struct Copy {
    Room room;
    const double* x[3];
    BRISANCE_HD void operator()(std::int64_t i) const {
        for (int a = 0; a < 3; ++a) {
            room.place[a][i] = x[a][i];
            room.sign[a][i] = 1;
        }
        room.of[i] = static_cast<std::int32_t>(i);
    }
};
struct Near {
    Room room;
    Mirror mirror;
    double reach;
    BRISANCE_HD bool operator()(std::int64_t i) const {
        const double d = room.place[mirror.axis][i] - mirror.at;
        return !(d > reach || d < -reach);
    }
};
struct Reflect {
    Room room;
    Mirror mirror;
    std::int64_t ahead;
    BRISANCE_HD void operator()(std::int64_t i, std::int64_t k) const {
        const std::int64_t to = ahead + k;
        if (to >= room.size) return;
        for (int a = 0; a < 3; ++a) {
            room.place[a][to] = a == mirror.axis ? 2 * mirror.at - room.place[a][i] : room.place[a][i];
            room.sign[a][to] = a == mirror.axis ? -room.sign[a][i] : room.sign[a][i];
        }
        room.of[to] = room.of[i];
    }
};

}  // namespace

void Mirrored::build(const FluidBody& b, double reach) {
    const std::int64_t n = b.size();
    size_ = n;
    if (b.mirrors.empty()) {
        view_ = {{b.x[0].data(), b.x[1].data(), b.x[2].data()}, nullptr, {}};
        return;
    }
    for (std::int64_t room = n + n / 4 + 64; !fill(b, reach, room); room = size_) {}  // more than enough, or what the first try has counted
    view_ = {{place_[0].data(), place_[1].data(), place_[2].data()}, of_.data(), {sign_[0].data(), sign_[1].data(), sign_[2].data()}};
}

/// False if `room` did not do; `size_` then tells what would.
bool Mirrored::fill(const FluidBody& b, double reach, std::int64_t room) {
    for (auto* group : {&place_, &sign_})
        for (auto& a : *group) make_room(a, static_cast<std::size_t>(room));
    make_room(of_, static_cast<std::size_t>(room));
    const Room to{{place_[0].data(), place_[1].data(), place_[2].data()}, {sign_[0].data(), sign_[1].data(), sign_[2].data()}, of_.data(), static_cast<std::int64_t>(of_.size())};
    size_ = b.size();
    exec::launch(size_, Copy{to, {b.x[0].data(), b.x[1].data(), b.x[2].data()}}, 1024);
    for (const Mirror& m : b.mirrors) {  // one after the other, so that corners are filled by images of images
        const std::int64_t standing = std::min(size_, to.size);
        size_ += exec::select(standing, Near{to, m, reach}, Reflect{to, m, size_});
    }
    return size_ <= to.size;
}

}  // namespace brisance
