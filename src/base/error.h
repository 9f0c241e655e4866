// SPDX-License-Identifier: Apache-2.0
// The ways in which brisance stops before its work is done. Each carries the exit code that a script sees.
#pragma once

#include <stdexcept>
#include <string>

namespace brisance {

enum class Exit : int { ok = 0, bad_input = 2, physics_stop = 3, resources = 4, interrupted = 5 };

class Error : public std::runtime_error {
public:
    Error(Exit code, const std::string& message) : std::runtime_error(message), code_(code) {}
    Exit code() const { return code_; }

private:
    Exit code_;
};

/// The user can mend this one: the message names file, line, column, key, value and what is allowed.
struct InputError : Error {
    explicit InputError(const std::string& message) : Error(Exit::bad_input, message) {}
};

/// The computation left the range in which its numbers mean something; the message holds the particle's whole row.
struct PhysicsStop : Error {
    explicit PhysicsStop(const std::string& message) : Error(Exit::physics_stop, message) {}
};

/// Memory, disk or permission; the message says how much was needed, or which path.
struct ResourceError : Error {
    explicit ResourceError(const std::string& message) : Error(Exit::resources, message) {}
};

/// A signal asked for the end.
struct Interrupted : Error {
    explicit Interrupted(const std::string& message) : Error(Exit::interrupted, message) {}
};

}  // namespace brisance
