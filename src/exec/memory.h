// SPDX-License-Identifier: Apache-2.0
// Memory of everything that a step touches. There is one copy of it: on a device run it is the device's (for CUDA: managed memory, which
// pages to the processor when output or a checkpoint reads it), so nothing can be stale. What must hold instead is that the processor
// leaves it alone within a step, but for a declared HostAccess, and that kernels touch nothing else. The split build enforces both: its
// pretend device keeps all arrays in an arena without access rights, opened for kernels and for HostAccess only.
#pragma once

#include "base/memory.h"

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <vector>

namespace brisance {

namespace exec {

#if defined(BRISANCE_CUDA) || defined(BRISANCE_SPLIT)
inline constexpr bool has_device = true;
#ifdef BRISANCE_CUDA
inline constexpr bool typed = true;  ///< kernels know the laws by their types, there being no virtual functions
#else
inline constexpr bool typed = false;
#endif
/// Whether arrays made from now on are the device's, and launched kernels run there. Set once, before a world is made.
bool on_device();
void use_device(bool on);
/// Memory of the device, aligned to a page.
void* device_allocate(std::size_t bytes);
/// False if the block is not the device's.
bool device_free(void* block);
/// Memory of what does not change, which kernels and the processor may read at any time.
void* constant_allocate(std::size_t bytes);
/// Kernels that were launched have ended.
void wait();

/// The stretch in which the device works alone.
class DevicePhase {
public:
    DevicePhase();
    ~DevicePhase();
    DevicePhase(const DevicePhase&) = delete;
    DevicePhase& operator=(const DevicePhase&) = delete;
};
/// Within a DevicePhase: the processor reads and writes the device's memory here.
class HostAccess {
public:
    HostAccess();
    ~HostAccess();
    HostAccess(const HostAccess&) = delete;
    HostAccess& operator=(const HostAccess&) = delete;
};
#else
inline constexpr bool has_device = false, typed = false;
inline bool on_device() { return false; }
inline void use_device(bool) {}
inline void* device_allocate(std::size_t) { return nullptr; }
inline bool device_free(void*) { return false; }
inline void* constant_allocate(std::size_t bytes) { return ::operator new(bytes); }
inline void wait() {}
struct DevicePhase {
    DevicePhase() {}
};
struct HostAccess {
    HostAccess() {}
};
#endif

}  // namespace exec

/// Memory on 64-byte boundaries, so that a pack never straddles a cache line. One array after the other begins one line further into its
/// page: equal slots of arrays of one size would else lie in the same set of the cache and drive each other out.
template <class T>
struct Allocator {
    using value_type = T;
    static constexpr std::size_t line = 64, lines_of_a_page = 64;
    Allocator() = default;
    template <class U> Allocator(const Allocator<U>&) {}
    T* allocate(std::size_t n) {
        if (n > (std::size_t{1} << 48)) throw std::bad_array_new_length();
        if (exec::on_device()) return static_cast<T*>(exec::device_allocate(n * sizeof(T)));
        static std::atomic<std::size_t> next{0};
        const std::size_t ahead = line * (1 + next++ % lines_of_a_page);
        const std::size_t bytes = n * sizeof(T) + line * lines_of_a_page;
        char* const block = static_cast<char*>(::operator new(bytes, std::align_val_t(line)));
        prefer_large_pages(block, bytes);
        std::memcpy(block + ahead - sizeof block, &block, sizeof block);  // where it began, for deallocate
        return reinterpret_cast<T*>(block + ahead);
    }
    void deallocate(T* p, std::size_t) {
        if (exec::device_free(p)) return;
        char* block;
        std::memcpy(&block, reinterpret_cast<char*>(p) - sizeof block, sizeof block);
        ::operator delete(block, std::align_val_t(line));
    }
    template <class U> bool operator==(const Allocator<U>&) const { return true; }
};
/// Of objects that are made once, such as laws.
template <class T>
struct ConstantAllocator {
    using value_type = T;
    ConstantAllocator() = default;
    template <class U> ConstantAllocator(const ConstantAllocator<U>&) {}
    T* allocate(std::size_t n) { return static_cast<T*>(exec::constant_allocate(n * sizeof(T))); }
    void deallocate(T* p, std::size_t) { ::operator delete(p); }
    template <class U> bool operator==(const ConstantAllocator<U>&) const { return true; }
};

/// An array that kernels may touch. Made, resized and read by the processor outside of a step, or under HostAccess.
template <class T> using Array = std::vector<T, Allocator<T>>;

/// Bare pointers of several arrays.
template <class Pointers, class Arrays>
void take_pointers(Pointers& to, Arrays& arrays) {
    for (std::size_t k = 0; k < arrays.size(); ++k) to[k] = arrays[k].data();
}

/// Room for n entries at least; what is in them is left open.
template <class T>
void make_room(Array<T>& a, std::size_t n) {
    if (a.size() >= n) return;
    const exec::HostAccess host;
    a.resize(n + n / 8);
}

}  // namespace brisance
