#include "tests/support/service/faulty_disk.h"

#include <sqlite3.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "common/base/check.h"

namespace fitroom::testing {
namespace {

namespace fs = std::filesystem;

enum class EventKind { kWrite, kTruncate, kSync, kRemove };

struct Event {
  EventKind kind = EventKind::kWrite;
  std::string file;   // Its name in its folder.
  int64_t place = 0;  // Offset of a write, new size of a truncation (unit: byte); 1: removed with the folder flushed.
  std::string bytes;  // Of a write.
};

struct Disk {
  sqlite3_vfs* real = nullptr;
  bool is_accounting = false;
  std::vector<Event> events;
  bool has_fault = false;
  FaultyDisk::Call fault = FaultyDisk::Call::kRead;
  int64_t calls_left = 0;

  void Note(Event event) {
    if (is_accounting) events.push_back(std::move(event));
  }
  bool Fails(FaultyDisk::Call call) {
    if (!has_fault || call != fault || calls_left-- > 0) return false;
    has_fault = false;
    return true;
  }
};

Disk& TheDisk() {
  static Disk disk;
  return disk;
}

// The engine's file, with the real one right behind it in memory.
struct DiskFile {
  sqlite3_file base;
  char* name;  // Owned; empty for files that do not last.

  sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
  bool lasts() const { return name[0] != '\0'; }
};

DiskFile* Of(sqlite3_file* file) { return reinterpret_cast<DiskFile*>(file); }
sqlite3_file* Real(sqlite3_file* file) { return Of(file)->real(); }

int Close(sqlite3_file* file) {
  const int code = Real(file)->pMethods->xClose(Real(file));
  delete[] Of(file)->name;
  return code;
}
int Read(sqlite3_file* file, void* bytes, int count, sqlite3_int64 offset) {
  if (TheDisk().Fails(FaultyDisk::Call::kRead)) return SQLITE_IOERR_READ;
  return Real(file)->pMethods->xRead(Real(file), bytes, count, offset);
}
int Write(sqlite3_file* file, const void* bytes, int count, sqlite3_int64 offset) {
  if (TheDisk().Fails(FaultyDisk::Call::kWrite)) return SQLITE_FULL;
  if (Of(file)->lasts()) {
    TheDisk().Note({EventKind::kWrite, Of(file)->name, offset,
                    std::string(static_cast<const char*>(bytes), static_cast<size_t>(count))});
  }
  return Real(file)->pMethods->xWrite(Real(file), bytes, count, offset);
}
int Truncate(sqlite3_file* file, sqlite3_int64 size) {
  if (Of(file)->lasts()) TheDisk().Note({EventKind::kTruncate, Of(file)->name, size, {}});
  return Real(file)->pMethods->xTruncate(Real(file), size);
}
int Sync(sqlite3_file* file, int) {
  if (TheDisk().Fails(FaultyDisk::Call::kSync)) return SQLITE_IOERR_FSYNC;
  if (Of(file)->lasts()) TheDisk().Note({EventKind::kSync, Of(file)->name, 0, {}});
  return SQLITE_OK;
}
int FileSize(sqlite3_file* file, sqlite3_int64* size) { return Real(file)->pMethods->xFileSize(Real(file), size); }
int Lock(sqlite3_file* file, int level) { return Real(file)->pMethods->xLock(Real(file), level); }
int Unlock(sqlite3_file* file, int level) { return Real(file)->pMethods->xUnlock(Real(file), level); }
int CheckReservedLock(sqlite3_file* file, int* result) {
  return Real(file)->pMethods->xCheckReservedLock(Real(file), result);
}
int FileControl(sqlite3_file* file, int operation, void* argument) {
  return Real(file)->pMethods->xFileControl(Real(file), operation, argument);
}
int SectorSize(sqlite3_file* file) { return Real(file)->pMethods->xSectorSize(Real(file)); }
int DeviceCharacteristics(sqlite3_file* file) { return Real(file)->pMethods->xDeviceCharacteristics(Real(file)); }
int ShmMap(sqlite3_file* file, int page, int size, int extend, void volatile** memory) {
  return Real(file)->pMethods->xShmMap(Real(file), page, size, extend, memory);
}
int ShmLock(sqlite3_file* file, int offset, int count, int flags) {
  return Real(file)->pMethods->xShmLock(Real(file), offset, count, flags);
}
void ShmBarrier(sqlite3_file* file) { Real(file)->pMethods->xShmBarrier(Real(file)); }
int ShmUnmap(sqlite3_file* file, int removes) { return Real(file)->pMethods->xShmUnmap(Real(file), removes); }

// Version 2: with shared memory, without mapped reads, so that every read comes past here.
const sqlite3_io_methods kMethods = {2,
                                     Close,
                                     Read,
                                     Write,
                                     Truncate,
                                     Sync,
                                     FileSize,
                                     Lock,
                                     Unlock,
                                     CheckReservedLock,
                                     FileControl,
                                     SectorSize,
                                     DeviceCharacteristics,
                                     ShmMap,
                                     ShmLock,
                                     ShmBarrier,
                                     ShmUnmap,
                                     nullptr,
                                     nullptr};

int Open(sqlite3_vfs*, const char* path, sqlite3_file* file, int flags, int* out_flags) {
  DiskFile* opened = Of(file);
  opened->base.pMethods = nullptr;
  const std::string name = path == nullptr ? "" : fs::path(path).filename().string();
  const int code = TheDisk().real->xOpen(TheDisk().real, path, opened->real(), flags, out_flags);
  if (code != SQLITE_OK) return code;
  opened->name = new char[name.size() + 1];
  std::memcpy(opened->name, name.c_str(), name.size() + 1);
  opened->base.pMethods = &kMethods;
  return SQLITE_OK;
}

int Remove(sqlite3_vfs*, const char* path, int syncs_folder) {
  TheDisk().Note({EventKind::kRemove, fs::path(path).filename().string(), /*place=*/syncs_folder != 0 ? 1 : 0, {}});
  return TheDisk().real->xDelete(TheDisk().real, path, syncs_folder);
}

void Apply(const Event& event, std::string& content) {
  const size_t place = static_cast<size_t>(event.place);
  if (event.kind == EventKind::kTruncate) {
    if (place < content.size()) content.resize(place);
    return;
  }
  if (content.size() < place + event.bytes.size()) content.resize(place + event.bytes.size());
  content.replace(place, event.bytes.size(), event.bytes);
}

// Applies a part of a write: sectors of it.
void ApplyTorn(const Event& event, std::mt19937& random, std::string& content) {
  constexpr size_t kSector = 512;
  for (size_t start = 0; start < event.bytes.size(); start += kSector) {
    if (random() % 2 == 0) continue;
    Apply(
        {EventKind::kWrite, event.file, event.place + static_cast<int64_t>(start), event.bytes.substr(start, kSector)},
        content);
  }
}

// What may be left of one file, from its last removal on.
std::string ContentAfter(const std::vector<const Event*>& events, std::mt19937& random) {
  size_t flushed = 0;
  for (size_t i = 0; i < events.size(); ++i) {
    if (events[i]->kind == EventKind::kSync) flushed = i;
  }
  std::string content;
  for (size_t i = 0; i < flushed; ++i) {
    if (events[i]->kind != EventKind::kSync) Apply(*events[i], content);
  }
  std::vector<const Event*> pending(events.begin() + static_cast<ptrdiff_t>(flushed), events.end());
  std::erase_if(pending, [](const Event* event) { return event->kind == EventKind::kSync; });
  if (random() % 4 == 0) {  // All of it has reached the disk in time.
    for (const Event* event : pending) Apply(*event, content);
    return content;
  }
  if (random() % 2 == 0) std::shuffle(pending.begin(), pending.end(), random);
  const unsigned loss = static_cast<unsigned>(random() % 4);  // Of four: nothing, little, much, or most is lost.
  for (const Event* event : pending) {
    if (random() % 4 < loss) continue;
    if (event->kind == EventKind::kWrite && random() % 4 == 0) {
      ApplyTorn(*event, random, content);
    } else {
      Apply(*event, content);
    }
  }
  return content;
}

}  // namespace

void FaultyDisk::Install() {
  if (TheDisk().real != nullptr) return;
  TheDisk().real = sqlite3_vfs_find(nullptr);
  FR_CHECK(TheDisk().real != nullptr);
  static sqlite3_vfs vfs = *TheDisk().real;  // All that is not replaced below is the real one's.
  vfs.zName = "faulty-disk";
  vfs.szOsFile = static_cast<int>(sizeof(DiskFile)) + TheDisk().real->szOsFile;
  vfs.pNext = nullptr;
  vfs.xOpen = Open;
  vfs.xDelete = Remove;
  FR_CHECK(sqlite3_vfs_register(&vfs, /*makeDflt=*/1) == SQLITE_OK);
}

void FaultyDisk::StartAccount() {
  TheDisk().events.clear();
  TheDisk().is_accounting = true;
}
void FaultyDisk::StopAccount() { TheDisk().is_accounting = false; }
int64_t FaultyDisk::event_count() { return static_cast<int64_t>(TheDisk().events.size()); }

void FaultyDisk::WriteCrashImage(int64_t event_count, std::mt19937& random, const fs::path& folder) {
  fs::create_directories(folder);
  // Events of the file that has each name now, and of the one that had it before and was removed.
  std::map<std::string, std::vector<const Event*>> files;
  std::map<std::string, std::vector<const Event*>> removed;
  for (int64_t i = 0; i < event_count; ++i) {
    const Event& event = TheDisk().events[static_cast<size_t>(i)];
    if (event.kind == EventKind::kRemove) {
      removed[event.file] = std::exchange(files[event.file], {});
      files.erase(event.file);
      if (event.place != 0) removed.erase(event.file);
    } else {
      files[event.file].push_back(&event);
      removed.erase(event.file);
    }
  }
  // A removal may not have reached the disk unless the folder was flushed with it.
  for (const auto& [name, events] : removed) {
    if (random() % 2 == 0) files[name] = events;
  }
  for (const auto& [name, events] : files) {
    const std::string content = ContentAfter(events, random);
    std::ofstream(folder / name, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
  }
}

void FaultyDisk::FailCall(Call call, int64_t number) {
  TheDisk().has_fault = true;
  TheDisk().fault = call;
  TheDisk().calls_left = number;
}

bool FaultyDisk::EndFault() { return !std::exchange(TheDisk().has_fault, false); }

}  // namespace fitroom::testing
