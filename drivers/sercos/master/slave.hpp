// One drive of the ring: its start-up, its service channel, its telegrams.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_SLAVE_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_SLAVE_HPP

#include "drivers/sercos/master/drive_axis.hpp"
#include "drivers/sercos/master/drive_config.hpp"
#include "drivers/sercos/master/parameter_transfer.hpp"
#include "drivers/sercos/master/service_channel.hpp"
#include "drivers/sercos/master/start_up.hpp"
#include "drivers/sercos/ring/ring.hpp"
#include "runtime/bus/news.hpp"

#include <cstdint>
#include <span>

namespace stride::sercos {

class Slave {
public:
  explicit Slave(const DriveConfig &config);

  /// The ring begins anew: nothing is known of the drive.
  void clear();
  /// The ring falls to phase 0. Why the drive has failed is still known.
  void leave();
  /// The ring is in phase 2, 3 or 4 now.
  void enter(Phase phase);
  void plan(const DriveTimes &times) { startUp_.plan(times); }

  /// Its AT of this cycle.
  void received(const DriveTelegram &telegram, bus::News &news);
  /// There was none, or it was distorted.
  void missed();
  /// Cycles in a row without one, since it has been expected.
  [[nodiscard]] uint32_t misses() const { return misses_; }
  /// There has been one since enter().
  [[nodiscard]] bool heard() const { return heard_; }

  /// Control word, word of the service channel and, in phases 3 and 4, its data.
  void fill(std::span<uint8_t> record);

  /// It has done what there is to do in this phase.
  [[nodiscard]] bool ready() const { return startUp_.state() == StartUp::State::Done; }
  [[nodiscard]] bool awaitsPlan() const { return startUp_.state() == StartUp::State::AwaitsPlan; }
  [[nodiscard]] bool failed() const { return failed_; }
  /// Why.
  [[nodiscard]] const bus::Message &fault() const { return fault_; }
  void fail(const bus::Message &fault);

  /// All drives are ready in phase 4: it is an axis now.
  void start();
  [[nodiscard]] bool started() const { return started_; }

  [[nodiscard]] bus::DriveStatus status() const;
  [[nodiscard]] DriveAxis &axis() { return axis_; }
  [[nodiscard]] const DriveAxis &axis() const { return axis_; }
  [[nodiscard]] const StartUp &startUp() const { return startUp_; }
  [[nodiscard]] const DriveConfig &config() const { return config_; }
  [[nodiscard]] const ServiceChannel &channel() const { return channel_; }

  /// A question of a program.
  void ask(const bus::ParameterRequest &request);
  bool poll(bus::ParameterAnswer &answer) { return parameters_.poll(answer); }
  void cancelQuestion();

private:
  enum class Owner : uint8_t { Nobody, Axis, Parameters };

  void serve(bus::News &news);
  void begin();
  void end(bus::News &news);
  void endWish(bus::News &news);
  bool answerFromTelegram(const bus::ParameterRequest &request);
  bool writeToTelegram(const bus::ParameterRequest &request);

  DriveConfig config_;
  ServiceChannel channel_;
  StartUp startUp_;
  DriveAxis axis_;
  ParameterTransfer parameters_;
  bus::Message fault_;
  DriveTelegram telegram_; ///< The last one.
  /// What programs have written of the data that goes in each cycle.
  std::array<uint8_t, kMostRecordBytes> own_{};
  ServiceWish wish_; ///< The axis's, that is under way.
  uint32_t misses_ = 0;
  Owner owner_ = Owner::Nobody;
  Owner last_ = Owner::Nobody; ///< Whose turn it was.
  Phase phase_ = Phase::Zero;
  bool heard_ = false;
  bool started_ = false;
  bool failed_ = false;
};

} // namespace stride::sercos

#endif
