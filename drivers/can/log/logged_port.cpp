#include "drivers/can/log/logged_port.hpp"

#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace stride::can::log {
namespace {

constexpr size_t kRoom = 65536; // frames: some seconds of a bus that is full
constexpr std::chrono::milliseconds kPause(20);

} // namespace

LoggedPort::LoggedPort(std::unique_ptr<Port> port, const LogSetup &setup)
    : port_(std::move(port)), interface_(setup.interface), recorder_(kRoom),
      recorded_(*port_, recorder_, setup.cycleNs, setup.startNs),
      file_(std::fopen(setup.file.c_str(), "w")) {
  if (file_ == nullptr)
    throw std::runtime_error(
        "the file '" + setup.file +
        "' for the frames of a bus cannot be written: " + std::strerror(errno));
  if (!setup.ownThread)
    return;
  writer_ = std::thread([this] {
    while (!ends_.load(std::memory_order_acquire)) {
      write();
      (void)std::fflush(file_.get());
      std::this_thread::sleep_for(kPause);
    }
  });
}

LoggedPort::~LoggedPort() {
  ends_.store(true, std::memory_order_release);
  if (writer_.joinable())
    writer_.join();
  write();
  if (recorder_.lost() > 0) // readers of the format pass over it
    (void)std::fprintf(file_.get(), "# %llu frames are missing: the file was too slow\n",
                       static_cast<unsigned long long>(recorder_.lost()));
}

void LoggedPort::beginCycle() noexcept {
  recorded_.beginCycle();
  if (!writer_.joinable())
    write();
}

void LoggedPort::write() noexcept {
  std::array<char, kLongestLine> line{};
  Entry entry;
  while (recorder_.take(entry)) {
    const size_t length = formatLine(entry, interface_, line.data(), line.size());
    if (std::fwrite(line.data(), 1, length, file_.get()) != length)
      unwritten_.fetch_add(1, std::memory_order_relaxed);
  }
}

} // namespace stride::can::log
