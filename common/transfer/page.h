#pragma once

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <vector>

#include "common/base/status.h"

namespace fitroom::transfer {

inline constexpr int kDefaultPageSize = 50;
inline constexpr int kMaxPageSize = 200;

// Returns how many entries a page holds; INVALID_ARGUMENT [PAGE_SIZE_INVALID] below 0.
inline Result<int> PageSize(int32_t requested) {
  if (requested < 0) return InvalidArgument("PAGE_SIZE_INVALID", "page_size: below 0");
  return requested == 0 ? kDefaultPageSize : std::min(int{requested}, kMaxPageSize);
}

// Cuts a list down to a page; says whether there was more. So a store is asked for one entry more than the page holds.
template <typename Item>
bool CutToPage(std::vector<Item>& items, int page_size) {
  if (std::ssize(items) <= page_size) return false;
  items.resize(static_cast<size_t>(page_size));
  return true;
}

}  // namespace fitroom::transfer
