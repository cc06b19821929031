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
/// where `gives_up` holds first; then it may be called later, or never.
template <class Result>
std::optional<Result> call_and_wait(std::function<Result()> call,
                                    const std::function<bool()>& gives_up) {
  const auto task = std::make_shared<std::packaged_task<Result()>>(std::move(call));
  std::future<Result> result = task->get_future();
  call_soon([task] { (*task)(); });
  while (result.wait_for(std::chrono::milliseconds(50)) != std::future_status::ready) {
    if (gives_up()) return std::nullopt;
  }
  return result.get();
}

}  // namespace mocha
