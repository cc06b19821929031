#pragma once

#include <chrono>
#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <utility>

namespace mocha {

/// Has `call` called from the node's callback queue, after what waits there. Any thread may say so.
void call_soon(std::function<void()> call);

/// The same, and waits for what it returns, on a thread that does not serve that queue. Nothing
/// where the node ends first.
template <class Result>
std::optional<Result> call_and_wait(std::function<Result()> call);

/// Waits for it; false where the node ends first.
bool wait_while_running(const std::function<bool()>& is_there);

template <class Result>
std::optional<Result> call_and_wait(std::function<Result()> call) {
  const auto task = std::make_shared<std::packaged_task<Result()>>(std::move(call));
  std::future<Result> result = task->get_future();
  call_soon([task] { (*task)(); });
  const bool is_there = wait_while_running([&] {
    return result.wait_for(std::chrono::milliseconds(50)) == std::future_status::ready;
  });
  return is_there ? std::optional<Result>(result.get()) : std::nullopt;
}

}  // namespace mocha
