#include "drivers/can/parameter_loader.hpp"

#include <algorithm>
#include <chrono>
#include <exception>

namespace stride::can {
namespace {

/// How soon the thread sees that something is wanted.
constexpr std::chrono::milliseconds kPause{5};

} // namespace

ParameterLoader::ParameterLoader(const bus::GroupSetup &setup) : setup_(setup) {
  if (setup.kind != bus::BusKind::Real)
    return;
  reader_ = std::thread([this] {
    while (!ends_.load(std::memory_order_acquire)) {
      read();
      std::this_thread::sleep_for(kPause);
    }
  });
}

ParameterLoader::~ParameterLoader() {
  ends_.store(true, std::memory_order_release);
  if (reader_.joinable())
    reader_.join();
}

bool ParameterLoader::isNeeded(const bus::GroupSetup &setup) {
  return setup.files &&
         std::any_of(setup.drives.begin(), setup.drives.end(), [](const bus::DriveSetup &drive) {
           return !drive.parameters.text("parameters").empty();
         });
}

bool ParameterLoader::poll() noexcept {
  if (!reader_.joinable())
    read();
  return read_.load(std::memory_order_acquire) == wanted_.load(std::memory_order_relaxed);
}

/// Who waits for what he has requested does not look at `loaded_` meanwhile.
void ParameterLoader::read() noexcept {
  const uint32_t wanted = wanted_.load(std::memory_order_acquire);
  if (wanted == read_.load(std::memory_order_relaxed))
    return;
  LoadedParameters fresh;
  try {
    const CanSetup can = canSetup(setup_);
    for (size_t i = 0; i < can.driveNodes; ++i)
      fresh.steps.push_back(startSteps(can.master.nodes[i]));
    fresh.faults = can.faults;
    fresh.notes = can.notes;
  } catch (const std::exception &problem) { // no memory
    fresh.faults.assign(setup_.drives.size(), problem.what());
  }
  loaded_ = std::move(fresh);
  read_.store(wanted, std::memory_order_release);
}

} // namespace stride::can
