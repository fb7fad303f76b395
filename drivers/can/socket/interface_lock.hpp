// Keeps masters of different processes apart that would lead the same drives.
#ifndef STRIDE_DRIVERS_CAN_SOCKET_INTERFACE_LOCK_HPP
#define STRIDE_DRIVERS_CAN_SOCKET_INTERFACE_LOCK_HPP

#include <string>

namespace stride::can {

/// Whoever has it is the master at that interface. It is advice among masters: who only listens, or
/// asks by SDO, needs none. It lives in the network namespace, as interfaces do, and is gone with
/// its process, however that ends. Masters of one process share it.
class InterfaceLock {
public:
  /// Throws std::runtime_error, with the process that has it, for people.
  explicit InterfaceLock(const std::string &interface);
  ~InterfaceLock();
  InterfaceLock(const InterfaceLock &) = delete;
  InterfaceLock &operator=(const InterfaceLock &) = delete;

private:
  int fd_;
};

} // namespace stride::can

#endif
