// SPDX-License-Identifier: Apache-2.0
// The build cuda: managed memory, one stream, device 0.
#ifdef BRISANCE_CUDA

#include "base/error.h"
#include "exec/device.h"
#include "exec/launch.h"

#include <mutex>
#include <string>
#include <unordered_set>

namespace brisance::exec {

namespace {
bool in_use = false;
std::mutex blocks_mutex;
std::unordered_set<void*>& blocks() {
    static auto* const b = new std::unordered_set<void*>;  // outlives every array
    return *b;
}
int phases = 0;
}  // namespace

namespace cuda {
void check(cudaError_t code, const char* what) {
    if (code != cudaSuccess) throw ResourceError(std::string("the device failed (") + what + "): " + cudaGetErrorString(code));
}
void settle() {
    if (phases == 0) check(cudaDeviceSynchronize(), "kernels");
}
void* scratch(int slot, std::size_t bytes) {
    static void* memory[5] = {};
    static std::size_t size[5] = {};
    if (size[slot] < bytes) {
        check(cudaDeviceSynchronize(), "kernels");
        check(cudaFree(memory[slot]), "memory");
        size[slot] = bytes + bytes / 4;
        check(cudaMalloc(&memory[slot], size[slot]), "memory");
    }
    return memory[slot];
}
}  // namespace cuda

bool on_device() { return in_use; }
void use_device(bool on) { in_use = on; }
void* device_allocate(std::size_t bytes) {
    void* p = nullptr;
    cuda::check(cudaMallocManaged(&p, bytes + 4096), "memory");
    const std::lock_guard lock(blocks_mutex);
    blocks().insert(p);
    return p;
}
bool device_free(void* block) {
    {
        const std::lock_guard lock(blocks_mutex);
        if (blocks().erase(block) == 0) return false;
    }
    cudaFree(block);  // waits for kernels that may still use it
    return true;
}
void* constant_allocate(std::size_t bytes) { return ::operator new(bytes); }  // kernels get laws by value
void wait() {
    if (in_use) cuda::check(cudaDeviceSynchronize(), "kernels");
}
DevicePhase::DevicePhase() { ++phases; }
DevicePhase::~DevicePhase() {
    if (--phases == 0 && in_use) cudaDeviceSynchronize();
}
HostAccess::HostAccess() { wait(); }
HostAccess::~HostAccess() = default;

DeviceInfo device_info() {
    DeviceInfo d;
    d.built = true;
    int count = 0;
    const cudaError_t code = cudaGetDeviceCount(&count);
    if (code != cudaSuccess || count == 0) {
        d.name = code != cudaSuccess ? cudaGetErrorString(code) : "no CUDA device on this machine";
        return d;
    }
    cudaDeviceProp p;
    std::size_t free = 0, total = 0;
    if (cudaGetDeviceProperties(&p, 0) != cudaSuccess || cudaMemGetInfo(&free, &total) != cudaSuccess) return d;
    d.found = true;
    d.name = p.name;
    d.memory = static_cast<double>(total);
    d.memory_free = static_cast<double>(free);
    return d;
}

}  // namespace brisance::exec

#endif
