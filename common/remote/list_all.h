#pragma once

#include <bit>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "common/base/status.h"

namespace fitroom::remote {

// The most entries, and the most pages, that a client gathers from one list.
inline constexpr int64_t kMaxListSize = 100000;

// A part of a list as a server gave it.
template <typename Item>
struct ListPage {
  std::vector<Item> items;
  std::string next_page_token;  // Empty on the last page.
};

// Gathers a whole list. `fetch` maps a page token, empty at the start, to Result<ListPage<Item>>; its error ends the
// list. DATA_LOSS [PAGE_TOKEN_REPEATED] if the tokens run in a circle; RESOURCE_EXHAUSTED [LIST_TOO_LONG].
template <typename Item, typename Fetch>
Result<std::vector<Item>> ListAll(const Fetch& fetch) {
  std::vector<Item> all;
  std::string token;
  // A token from before: it moves on at every power of two, so that any circle comes back to it (Brent).
  std::string milestone;
  for (int64_t page_count = 1;; ++page_count) {
    Result<ListPage<Item>> page = fetch(std::as_const(token));
    if (!page.ok()) return page.status();
    if (std::ssize(page->items) > kMaxListSize - std::ssize(all) || page_count > kMaxListSize) {
      return ResourceExhausted("LIST_TOO_LONG",
                               "the server's list has more than " + std::to_string(kMaxListSize) + " entries or pages");
    }
    std::move(page->items.begin(), page->items.end(), std::back_inserter(all));
    token = std::move(page->next_page_token);
    if (token.empty()) return all;
    if (token == milestone) {
      return DataLoss("PAGE_TOKEN_REPEATED", "the server's list runs in a circle; look at the server");
    }
    if (std::has_single_bit(static_cast<uint64_t>(page_count))) milestone = token;
  }
}

}  // namespace fitroom::remote
