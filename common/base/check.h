#pragma once

namespace fitroom {

// Prints the broken precondition to standard error and aborts: it is a bug of the program, never of its input.
[[noreturn]] void FailCheck(const char* expression, const char* file, int line);

}  // namespace fitroom

#define FR_CHECK(condition) ((condition) ? void(0) : ::fitroom::FailCheck(#condition, __FILE__, __LINE__))

#ifdef NDEBUG
#define FR_DCHECK(condition) ((void)sizeof(condition))
#else
#define FR_DCHECK(condition) FR_CHECK(condition)
#endif
