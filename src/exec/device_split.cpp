// SPDX-License-Identifier: Apache-2.0
// The build split: a pretend device, an arena of address space. Within a DevicePhase nobody may touch it but a kernel, or the processor under
// HostAccess; whoever does stops the program.
#ifdef BRISANCE_SPLIT

#include "base/error.h"
#include "exec/device.h"
#include "exec/launch.h"

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <sys/mman.h>
#include <unistd.h>

namespace brisance::exec {

namespace {

constexpr std::size_t arena_size = std::size_t{1} << 38, page = 4096;

class Arena {
public:
    Arena() {
        void* p = mmap(nullptr, arena_size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        if (p == MAP_FAILED) throw ResourceError("no address space for the pretend device");
        base_ = static_cast<char*>(p);
        madvise(p, arena_size, MADV_HUGEPAGE);  // fewer entries to change at each opening
        struct sigaction action {};
        action.sa_sigaction = trespass;
        action.sa_flags = SA_SIGINFO;
        sigaction(SIGSEGV, &action, nullptr);
    }
    bool holds(const void* p) const { return p >= base_ && p < base_ + arena_size; }
    void* allocate(std::size_t bytes) {
        const std::lock_guard lock(mutex_);
        const std::size_t size = (bytes + 2 * page - 1) / page * page;  // a page more at least: packs may read past the end
        char* p;
        if (const auto it = free_.find(size); it != free_.end()) {
            p = it->second;
            free_.erase(it);
        } else {
            p = base_ + used_;
            used_ += size;
            if (used_ > arena_size) throw ResourceError("the pretend device is full");
        }
        sizes_[p] = size;
        return p;
    }
    bool deallocate(void* p) {
        const std::lock_guard lock(mutex_);
        const auto it = sizes_.find(static_cast<char*>(p));
        if (it == sizes_.end()) return false;
        free_.emplace(it->second, it->first);
        sizes_.erase(it);
        return true;
    }
    void protect(bool closed) {
        if (closed == closed_) return;
        closed_ = closed;
        // all of it: what is allocated later must be as this is
        if (mprotect(base_, arena_size, closed ? PROT_NONE : PROT_READ | PROT_WRITE) != 0) std::abort();
    }
    bool is_constant(const void* p) const {
        auto it = constants.upper_bound(static_cast<const char*>(p));
        return it != constants.begin() && static_cast<const char*>(p) < (--it)->first + it->second;
    }
    std::map<const char*, std::size_t> constants;  ///< begin and size
    int phases = 0, guests = 0;
    void settle() { protect(phases > 0 && guests == 0); }

private:
    static void trespass(int, siginfo_t* info, void*);
    char* base_ = nullptr;
    std::size_t used_ = 0;
    bool closed_ = false;
    std::mutex mutex_;
    std::multimap<std::size_t, char*> free_;
    std::map<char*, std::size_t> sizes_;
};

Arena& arena() {
    static Arena* const a = new Arena;  // outlives every array
    return *a;
}

void Arena::trespass(int, siginfo_t* info, void*) {
    constexpr char ours[] = "the processor touched memory of the device within a step, without HostAccess\n", other[] = "segmentation fault\n";
    const bool is_ours = arena().holds(info->si_addr);
    [[maybe_unused]] const auto written = is_ours ? write(2, ours, sizeof ours - 1) : write(2, other, sizeof other - 1);
    std::signal(SIGABRT, SIG_DFL);
    std::abort();
}

bool in_use = true;

}  // namespace

bool on_device() { return in_use; }
void use_device(bool on) { in_use = on; }
void* device_allocate(std::size_t bytes) { return arena().allocate(bytes); }
bool device_free(void* block) { return arena().deallocate(block); }
void* constant_allocate(std::size_t bytes) {
    void* const p = ::operator new(bytes);
    arena().constants.emplace(static_cast<const char*>(p), bytes);  // for good: what lies there later is as harmless
    return p;
}
void wait() {}

DevicePhase::DevicePhase() {
    if (!in_use) return;
    ++arena().phases;
    arena().settle();
}
DevicePhase::~DevicePhase() {
    if (!in_use) return;
    --arena().phases;
    arena().settle();
}
HostAccess::HostAccess() {
    ++arena().guests;
    arena().settle();
}
HostAccess::~HostAccess() {
    --arena().guests;
    arena().settle();
}

namespace detail {
Opened::Opened() {
    ++arena().guests;
    arena().settle();
}
void Opened::look(const void* kernel, std::size_t size) {
    if (!in_use || arena().phases == 0) return;
    // A device cannot follow a pointer to the processor's memory. Any word that could be one, a user's address in the upper half of the lower half
    // of the address space or the program's own, is taken as one.
    for (std::size_t at = 0; at + sizeof(std::uintptr_t) <= size; at += sizeof(std::uintptr_t)) {
        std::uintptr_t word;
        std::memcpy(&word, static_cast<const char*>(kernel) + at, sizeof word);
        const std::uintptr_t top = word >> 40;
        if ((top != 0x7f && top != 0x7e && top != 0x55 && top != 0x56) || arena().holds(reinterpret_cast<const void*>(word)) ||
            arena().is_constant(reinterpret_cast<const void*>(word)))
            continue;
        unsigned char resident;
        if (mincore(reinterpret_cast<void*>(word & ~std::uintptr_t{page - 1}), page, &resident) != 0) continue;  // nothing lies there
        std::fprintf(stderr, "a kernel holds the address %p, which is not memory of the device (byte %zu of %zu)\n", reinterpret_cast<void*>(word), at, size);
        std::abort();
    }
}
Opened::~Opened() {
    --arena().guests;
    arena().settle();
}
}  // namespace detail

DeviceInfo device_info() { return {true, true, "a pretend device (build split)", static_cast<double>(arena_size), static_cast<double>(arena_size)}; }

}  // namespace brisance::exec

#endif
