#pragma once

#include <string_view>

namespace fitroom {

// Says whether `id` may name a body, scan or garment: [a-z0-9-]{1,63}. Such an id is safe in a path.
inline bool IsResourceId(std::string_view id) {
  if (id.empty() || id.size() > 63) return false;
  for (const char c : id) {
    if (!((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '-')) return false;
  }
  return true;
}

}  // namespace fitroom
