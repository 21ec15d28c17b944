// Helpers for C++11 and later over frangible.h: failures are exceptions, handles free themselves, structs know their size.
#ifndef FRANGIBLE_HPP
#define FRANGIBLE_HPP

#include "frangible.h"

#include <cstring>
#include <stdexcept>

namespace frangible {

/// A call that failed, with the library's text.
struct Error : std::runtime_error {
    frangible_status status;
    explicit Error(frangible_status code) : std::runtime_error(frangible_error_text()), status(code) {}
};

inline void check(frangible_status status) {
    if (status != FRANGIBLE_STATUS_OK) throw Error(status);
}

/// A struct of frangible.h, all zeros but for its `size`.
template <class T> T sized() {
    T value = T();
    const uint32_t size = sizeof value;
    std::memcpy(&value, &size, sizeof size);
    return value;
}

/// Calls a function that writes to its last argument, and returns what it wrote: `ask<frangible_report>(frangible_outcome_report, outcome)`.
template <class T, class... Parameters, class... Arguments>
T ask(frangible_status (*function)(Parameters...), const Arguments &...arguments) {
    T answer = sized<T>();
    check(function(arguments..., &answer));
    return answer;
}

inline void release(frangible_breakable handle) { frangible_breakable_free(handle); }
inline void release(frangible_body handle) { frangible_body_free(handle); }
inline void release(frangible_outcome handle) { frangible_outcome_free(handle); }

/// A handle that frees itself. It is given to the functions as it is.
template <class Handle> class Owned {
    Handle handle;

public:
    Owned() : handle() {}
    Owned(Handle given) : handle(given) {}
    Owned(Owned &&other) noexcept : handle(other.handle) { other.handle = Handle(); }
    Owned &operator=(Owned &&other) noexcept {
        const Handle mine = handle;
        handle = other.handle;
        other.handle = mine;
        return *this;
    }
    ~Owned() { release(handle); }
    operator Handle() const { return handle; }
    explicit operator bool() const { return handle.id != 0; }
};

typedef Owned<frangible_breakable> Breakable;
typedef Owned<frangible_body> Body;
typedef Owned<frangible_outcome> Outcome;

} // namespace frangible

#endif
