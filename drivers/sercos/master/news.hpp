// What the master says to people.
#ifndef STRIDE_DRIVERS_SERCOS_MASTER_NEWS_HPP
#define STRIDE_DRIVERS_SERCOS_MASTER_NEWS_HPP

#include "runtime/bus/axis_driver.hpp"

namespace stride::sercos {

/// Hands texts on to whoever runs the driver, if there is somebody.
class News {
public:
  void attach(bus::DriverHost &host) { host_ = &host; }

  template <class... Parts> void say(const Parts &...parts) {
    if (host_ == nullptr)
      return;
    bus::Message message;
    message.set(parts...);
    host_->say(message);
  }

private:
  bus::DriverHost *host_ = nullptr;
};

} // namespace stride::sercos

#endif
