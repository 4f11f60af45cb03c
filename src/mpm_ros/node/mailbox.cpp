#include "mpm_ros/node/mailbox.hpp"

#include <algorithm>
#include <exception>

namespace mpm_ros {

bool Mailbox::call(const std::function<void()>& work, Turn turn) {
  std::unique_lock<std::mutex> lock(mutex_);
  if (closed_) return false;
  Letter letter{&work, turn};
  letters_.insert(turn == Turn::last ? letters_.end() : letters_.begin(), &letter);
  if (turn == Turn::at_once) ++urgent_;
  changed_.notify_all();
  // A letter that has left the queue is being worked on and will be done, closed or not.
  const auto waits = [&] { return std::find(letters_.begin(), letters_.end(), &letter) != letters_.end(); };
  const auto late = [&] { return busy_since_ && std::chrono::steady_clock::now() >= *busy_since_ + kBusyPatience; };
  while (!letter.done && !((closed_ || late()) && waits())) {
    if (busy_since_ && waits()) {
      changed_.wait_until(lock, *busy_since_ + kBusyPatience);
    } else {
      changed_.wait(lock);
    }
  }
  if (letter.done) return true;
  letters_.erase(std::find(letters_.begin(), letters_.end(), &letter));
  if (turn == Turn::at_once) --urgent_;
  return false;
}

void Mailbox::run_until(std::chrono::steady_clock::time_point deadline) {
  std::unique_lock<std::mutex> lock(mutex_);
  changed_.wait_until(lock, deadline, [this] { return !letters_.empty() || closed_; });
  while (!letters_.empty() && !closed_) {
    Letter* letter = letters_.front();
    letters_.pop_front();
    if (letter->turn == Turn::at_once) --urgent_;
    lock.unlock();
    std::exception_ptr error;
    try {
      (*letter->work)();
    } catch (...) {
      error = std::current_exception();
    }
    lock.lock();
    letter->done = true;
    changed_.notify_all();
    if (error) std::rethrow_exception(error);
  }
}

void Mailbox::set_busy(bool busy) {
  const std::lock_guard<std::mutex> lock(mutex_);
  busy_since_.reset();
  if (busy) busy_since_ = std::chrono::steady_clock::now();
  changed_.notify_all();
}

bool Mailbox::closed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return closed_;
}

void Mailbox::close() {
  const std::lock_guard<std::mutex> lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

}  // namespace mpm_ros
