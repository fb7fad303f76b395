// A master with scripted drives.
#ifndef STRIDE_TESTS_UNIT_SERCOS_MASTER_MASTER_SCENE_HPP
#define STRIDE_TESTS_UNIT_SERCOS_MASTER_MASTER_SCENE_HPP

#include "drivers/sercos/master/master.hpp"
#include "drivers/sercos/schema.hpp"

#include "tests/unit/sercos_master/scripted_ring.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace stride::sercos::test {

class Host final : public bus::DriverHost {
public:
  void raise(bus::BusEvent) noexcept override {}
  void say(const bus::Message &news) noexcept override { said.emplace_back(news.text()); }
  std::vector<std::string> said;
};

class MasterScene : public testing::Test {
protected:
  /// A drive that is sent positions: 8 bytes each way.
  DriveConfig &add(uint8_t address) {
    ScriptedDrive &drive = drives.emplace_back(address);
    drive.feedback = dword(1000U * address);
    drive.length = 8;
    DriveConfig &added = config.drives.emplace_back();
    added.address = address;
    CyclicWish wish;
    wish.controlType = 4;
    std::vector<std::string> errors;
    added.settings.cyclic = planCyclic(wish, errors);
    return added;
  }

  void make() {
    config.cycle = 0.002;
    config.megabits = 4;
    auto owned = std::make_unique<ScriptedRing>();
    ring = owned.get();
    for (ScriptedDrive &drive : drives)
      if (std::find(absent.begin(), absent.end(), drive.address()) == absent.end())
        ring->drives.push_back(&drive);
    master = std::make_unique<Master>(config, std::move(owned));
    master->attach(host);
  }

  /// One cycle; whoever is asked starts.
  void cycle() {
    master->executeStart();
    for (size_t i = 0; i < config.drives.size(); ++i) {
      if (ended.size() <= i)
        ended.resize(i + 1, bus::StartUp::Busy);
      if (ended[i] != bus::StartUp::Busy)
        continue;
      bus::Message message;
      uint16_t progress = 0;
      ended[i] = master->init(i, progress, message);
      EXPECT_LE(progress, 99);
      last = i == 0 ? progress : last;
      if (ended[i] == bus::StartUp::Failed)
        text = std::to_string(config.drives[i].address) + ": " + std::string(message.text());
    }
    master->executeEnd();
  }

  /// Until all have started or one has failed.
  bool start(int most = 4000) {
    for (int i = 0; i < most; ++i) {
      cycle();
      if (std::any_of(ended.begin(), ended.end(),
                      [](bus::StartUp one) { return one == bus::StartUp::Failed; }))
        return false;
      if (std::all_of(ended.begin(), ended.end(),
                      [](bus::StartUp one) { return one == bus::StartUp::Started; }))
        return true;
    }
    text = "it does not end";
    return false;
  }

  /// As SMC_ResetAxisGroup does it.
  void resetAll() {
    for (size_t i = 0; i < config.drives.size(); ++i)
      master->reset(i);
    ended.assign(config.drives.size(), bus::StartUp::Busy);
    last = 0;
    text.clear();
  }

  bool wrote(size_t drive, const std::string &line) const {
    const std::vector<std::string> &all = drives[drive].written;
    return std::find(all.begin(), all.end(), line) != all.end();
  }

  MasterConfig config;
  std::deque<ScriptedDrive> drives;
  std::vector<uint8_t> absent; ///< Addresses that are in the configuration only.
  ScriptedRing *ring = nullptr;
  std::unique_ptr<Master> master;
  Host host;
  std::vector<bus::StartUp> ended;
  uint16_t last = 0; ///< Progress of the first one.
  std::string text;  ///< Why it has failed.
};

} // namespace stride::sercos::test

#endif
