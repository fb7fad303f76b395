// What a driver says to people.
#ifndef STRIDE_RUNTIME_BUS_NEWS_HPP
#define STRIDE_RUNTIME_BUS_NEWS_HPP

#include "runtime/bus/axis_driver.hpp"

namespace stride::bus {

/// Hands texts on to whoever runs the driver, if there is somebody.
class News {
public:
  void attach(DriverHost &host) { host_ = &host; }

  template <class... Parts> void say(const Parts &...parts) {
    if (host_ == nullptr)
      return;
    Message message;
    message.set(parts...);
    host_->say(message);
  }

private:
  DriverHost *host_ = nullptr;
};

} // namespace stride::bus

#endif
