#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace fitroom {

// Receives the progress of a long operation: the stage's name and the part of the whole that is done, 0 to 1.
// Called from the thread that does the work. An empty function is allowed where one is taken by value.
using ProgressSink = std::function<void(std::string_view stage, double done)>;

// Draws a progress bar on standard error when that is a terminal and NO_PROGRESS is not set; silent otherwise.
// Not thread-safe. The bar is ended by the destructor.
class ProgressBar {
 public:
  ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar();

  void Update(std::string_view stage, double done);
  ProgressSink sink() {
    return [this](std::string_view stage, double done) { Update(stage, done); };
  }

 private:
  bool visible_ = false;
  bool drawn_ = false;
  std::string last_;
};

}  // namespace fitroom
