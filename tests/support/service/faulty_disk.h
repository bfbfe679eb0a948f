#pragma once

#include <cstdint>
#include <filesystem>
#include <random>

namespace fitroom::testing {

// A disk under SQLite that can lose power and that can fail: the engine's default file system of this process from
// Install() on. It keeps an account of what was written and what was flushed; flushing itself costs nothing. Not
// thread-safe: one test, one thread.
class FaultyDisk {
 public:
  enum class Call { kRead, kWrite, kSync };

  // Puts the disk under the engine. Once per process; before the first database is opened.
  static void Install();

  // Forgets the account and counts events (writes, truncations, flushes, removals) from 0 on.
  static void StartAccount();
  static void StopAccount();
  static int64_t event_count();

  // Fills `folder` with what the disk may hold if the power fails after the first `event_count` events: everything that
  // was flushed; of the rest any part, in any order, whole or torn into sectors of 512 bytes.
  static void WriteCrashImage(int64_t event_count, std::mt19937& random, const std::filesystem::path& folder);

  // Makes the call number `number` of its sort, counted from now and from 0, fail once.
  static void FailCall(Call call, int64_t number);
  // Says whether it has failed; forgets it if not.
  static bool EndFault();
};

}  // namespace fitroom::testing
