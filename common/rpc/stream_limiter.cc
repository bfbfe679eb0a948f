#include "common/rpc/stream_limiter.h"

#include <utility>

namespace fitroom::rpc {

StreamLimiter::Ticket::Ticket(Ticket&& other) noexcept
    : limiter_(std::exchange(other.limiter_, nullptr)), peer_(std::move(other.peer_)) {}

StreamLimiter::Ticket& StreamLimiter::Ticket::operator=(Ticket&& other) noexcept {
  if (this != &other) {
    Release();
    limiter_ = std::exchange(other.limiter_, nullptr);
    peer_ = std::move(other.peer_);
  }
  return *this;
}

void StreamLimiter::Ticket::Release() {
  if (limiter_ == nullptr) return;
  const std::lock_guard lock(limiter_->mutex_);
  --limiter_->open_;
  const auto found = limiter_->open_by_peer_.find(peer_);
  if (--found->second == 0) limiter_->open_by_peer_.erase(found);
  limiter_ = nullptr;
}

Result<StreamLimiter::Ticket> StreamLimiter::Admit(const std::string& peer) {
  const std::lock_guard lock(mutex_);
  if (open_ >= limits_.stream_count) {
    return ResourceExhausted("SERVER_BUSY", "the server has too many open streams; try again in a few seconds");
  }
  const auto found = open_by_peer_.find(peer);
  if (found != open_by_peer_.end() && found->second >= limits_.stream_count_per_peer) {
    return ResourceExhausted("TOO_MANY_STREAMS", "this connection has too many open streams; end some first");
  }
  ++open_by_peer_[peer];
  ++open_;
  return Ticket(this, peer);
}

}  // namespace fitroom::rpc
