#include "drivers/can/socket/socket_can_port.hpp"

#include "drivers/can/socket/can_link.hpp"

#include <linux/can.h>
#include <linux/can/error.h>
#include <linux/can/raw.h>
#include <linux/net_tstamp.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/uio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <utility>

namespace stride::can {
namespace {

constexpr int64_t kSecondNs = 1000000000;
constexpr int kReceiveBuffer = 1 << 20; // the default holds 278 frames
constexpr int kProcessPriority = 6;     // the first band of pfifo_fast
constexpr size_t kBatch = 32;

int64_t monotonicNow() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  return now.tv_sec * kSecondNs + now.tv_nsec;
}

template <class T> bool setOption(int fd, int level, int option, const T &value) {
  return ::setsockopt(fd, level, option, &value, sizeof value) == 0;
}

/// What belongs to a received frame.
struct Control {
  int64_t timeNs = 0;
  uint32_t dropped = 0;
  bool hasDropped = false;
};

Control readControl(msghdr &message) {
  Control control;
  for (cmsghdr *one = CMSG_FIRSTHDR(&message); one != nullptr; one = CMSG_NXTHDR(&message, one)) {
    if (one->cmsg_level != SOL_SOCKET)
      continue;
    if (one->cmsg_type == SO_RXQ_OVFL && one->cmsg_len >= CMSG_LEN(sizeof(uint32_t))) {
      std::memcpy(&control.dropped, CMSG_DATA(one), sizeof control.dropped);
      control.hasDropped = true;
    } else if (one->cmsg_type == SO_TIMESTAMPING && one->cmsg_len >= CMSG_LEN(sizeof(timespec))) {
      timespec time{};
      std::memcpy(&time, CMSG_DATA(one), sizeof time); // the first of three: the system's clock
      control.timeNs = time.tv_sec * kSecondNs + time.tv_nsec;
    }
  }
  return control;
}

bool isGone(int error) {
  return error == ENETDOWN || error == ENODEV || error == ENXIO || error == ENOTCONN ||
         error == EBADF;
}

} // namespace

SocketCanPort::SocketCanPort(std::string interface, uint32_t bitRate)
    : interface_(std::move(interface)), bitRate_(bitRate) {
  open();
}

SocketCanPort::~SocketCanPort() { close(); }

void SocketCanPort::setProblem(const char *format, ...) noexcept {
  va_list arguments;
  va_start(arguments, format);
  const int length = std::vsnprintf(problem_.data(), problem_.size(), format, arguments);
  va_end(arguments);
  problemLength_ = std::min(static_cast<size_t>(std::max(length, 0)), problem_.size() - 1);
}

void SocketCanPort::close() noexcept {
  for (int *fd : {&process_, &service_}) {
    if (*fd >= 0)
      ::close(*fd);
    *fd = -1;
  }
  flying_ = 0;
  droppedBySocket_ = 0;
}

void SocketCanPort::goDown(int error) noexcept {
  close();
  state_ = ControllerState::Down;
  nextTryNs_ = monotonicNow() + kSecondNs;
  setProblem("the interface '%s' is gone or down (%s)", interface_.c_str(),
             error == ENETDOWN ? "network is down" : "no such device");
}

/// Whether the interface can be used as it is.
bool SocketCanPort::usable(unsigned index) noexcept {
  const CanLink link = readLink(index);
  const char *name = interface_.c_str();
  const unsigned rate = bitRate_ == 0 ? 1000 : bitRate_;
  if (link.known && !link.isUp) {
    if (link.hasState)
      setProblem("the interface '%s' is down: ip link set %s up type can bitrate %u restart-ms 100",
                 name, name, rate * 1000);
    else
      setProblem("the interface '%s' is down: ip link set %s up", name, name);
    return false;
  }
  if (link.bitRate != 0 && bitRate_ != 0 && link.bitRate != bitRate_ * 1000) {
    setProblem("the interface '%s' runs at %u bit/s, BaudRate is %u kBit/s", name, link.bitRate,
               bitRate_);
    return false;
  }
  if (link.hasState)
    state_ = link.state;
  else
    state_ = ControllerState::Active;
  return true;
}

int SocketCanPort::openSocket(unsigned index, SendClass sendClass) noexcept {
  const int fd = ::socket(PF_CAN, SOCK_RAW | SOCK_CLOEXEC | SOCK_NONBLOCK, CAN_RAW);
  if (fd < 0)
    return -1;
  bool good = true;
  if (sendClass == SendClass::Process) {
    constexpr can_err_mask_t kErrors = CAN_ERR_BUSOFF | CAN_ERR_RESTARTED | CAN_ERR_CRTL |
                                       CAN_ERR_ACK | CAN_ERR_TX_TIMEOUT | CAN_ERR_LOSTARB;
    constexpr int kOn = 1;
    constexpr int kStamps = SOF_TIMESTAMPING_RX_SOFTWARE | SOF_TIMESTAMPING_SOFTWARE;
    good = setOption(fd, SOL_CAN_RAW, CAN_RAW_ERR_FILTER, kErrors) &&
           setOption(fd, SOL_CAN_RAW, CAN_RAW_RECV_OWN_MSGS, kOn) &&
           setOption(fd, SOL_SOCKET, SO_RXQ_OVFL, kOn);
    // Without these it works as well.
    (void)setOption(fd, SOL_SOCKET, SO_TIMESTAMPING, kStamps);
    (void)setOption(fd, SOL_SOCKET, SO_PRIORITY, kProcessPriority);
    if (!setOption(fd, SOL_SOCKET, SO_RCVBUFFORCE, kReceiveBuffer))
      (void)setOption(fd, SOL_SOCKET, SO_RCVBUF, kReceiveBuffer);
  } else {
    good = ::setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, nullptr, 0) == 0; // it receives nothing
  }
  sockaddr_can address{};
  address.can_family = AF_CAN;
  address.can_ifindex = static_cast<int>(index);
  if (good && ::bind(fd, reinterpret_cast<const sockaddr *>(&address), sizeof address) == 0)
    return fd;
  const int error = errno;
  ::close(fd);
  errno = error;
  return -1;
}

void SocketCanPort::open() noexcept {
  close();
  state_ = ControllerState::Down;
  nextTryNs_ = monotonicNow() + kSecondNs;
  const unsigned index = ::if_nametoindex(interface_.c_str());
  if (index == 0) {
    setProblem("there is no interface '%s': ip link shows which there are", interface_.c_str());
    return;
  }
  if (!usable(index)) {
    state_ = ControllerState::Down;
    return;
  }
  process_ = openSocket(index, SendClass::Process);
  service_ = process_ < 0 ? -1 : openSocket(index, SendClass::Service);
  if (service_ >= 0) {
    problemLength_ = 0;
    return;
  }
  const int error = errno;
  close();
  state_ = ControllerState::Down;
  if (error == EAFNOSUPPORT || error == EPROTONOSUPPORT)
    setProblem("the kernel has no CAN (SocketCAN): modprobe can_raw");
  else
    setProblem("the interface '%s' cannot be opened: errno %d", interface_.c_str(), error);
}

void SocketCanPort::beginCycle() noexcept {
  ++cycle_;
  if (process_ < 0 && monotonicNow() >= nextTryNs_)
    open();
}

SendResult SocketCanPort::send(const Frame &frame, SendClass sendClass) noexcept {
  const bool process = sendClass == SendClass::Process;
  if (process_ < 0)
    return SendResult::Down;
  can_frame raw{};
  raw.can_id = frame.id & CAN_SFF_MASK;
  if (frame.remote)
    raw.can_id |= CAN_RTR_FLAG;
  raw.can_dlc = std::min<uint8_t>(frame.length, CAN_MAX_DLEN);
  std::copy_n(frame.data.begin(), raw.can_dlc, raw.data);
  ssize_t sent = 0;
  do
    sent = ::send(process ? process_ : service_, &raw, sizeof raw, MSG_DONTWAIT);
  while (sent < 0 && errno == EINTR);
  if (sent < 0) {
    if (!isGone(errno))
      return SendResult::QueueFull;
    goDown(errno);
    return SendResult::Down;
  }
  if (process && flying_ < inFlight_.size()) {
    inFlight_[(oldest_ + flying_) % inFlight_.size()] = {cycle_, frame.id};
    ++flying_;
  }
  return SendResult::Sent;
}

/// A frame of ours has left the controller. What was sent before it and has not been confirmed will
/// not be any more.
void SocketCanPort::confirm(uint16_t id) noexcept {
  for (size_t i = 0; i < flying_; ++i) {
    if (inFlight_[(oldest_ + i) % inFlight_.size()].id != id)
      continue;
    oldest_ = (oldest_ + i + 1) % inFlight_.size();
    flying_ -= i + 1;
    return;
  }
}

size_t SocketCanPort::unconfirmed() const noexcept {
  size_t count = 0;
  for (size_t i = 0; i < flying_; ++i)
    count += inFlight_[(oldest_ + i) % inFlight_.size()].cycle != cycle_ ? 1 : 0;
  return count;
}

void SocketCanPort::takeError(const can_frame &frame) noexcept {
  ++counters_.errorFrames;
  if ((frame.can_id & CAN_ERR_RESTARTED) != 0) {
    ++counters_.restarts;
    flying_ = 0;
    state_ = ControllerState::Active;
  }
  if ((frame.can_id & CAN_ERR_CRTL) != 0) {
    const uint8_t what = frame.data[1];
    if ((what & (CAN_ERR_CRTL_RX_PASSIVE | CAN_ERR_CRTL_TX_PASSIVE)) != 0)
      state_ = ControllerState::Passive;
    else if ((what & (CAN_ERR_CRTL_RX_WARNING | CAN_ERR_CRTL_TX_WARNING)) != 0)
      state_ = ControllerState::Warning;
    else if ((what & CAN_ERR_CRTL_ACTIVE) != 0)
      state_ = ControllerState::Active;
  }
  if ((frame.can_id & CAN_ERR_BUSOFF) != 0) {
    state_ = ControllerState::BusOff;
    flying_ = 0;
  }
}

/// TRUE: it is a frame for whoever asked.
bool SocketCanPort::take(const can_frame &frame, bool confirms, Received &received) noexcept {
  if ((frame.can_id & CAN_ERR_FLAG) != 0) {
    takeError(frame);
    return false;
  }
  if ((frame.can_id & CAN_EFF_FLAG) != 0) // CANopen has none
    return false;
  const auto id = static_cast<uint16_t>(frame.can_id & CAN_SFF_MASK);
  if (confirms) {
    confirm(id);
    return false;
  }
  received.frame = {};
  received.frame.id = id;
  received.frame.remote = (frame.can_id & CAN_RTR_FLAG) != 0;
  if (!received.frame.remote) {
    received.frame.length = std::min<uint8_t>(frame.can_dlc, CAN_MAX_DLEN);
    std::copy_n(frame.data, received.frame.length, received.frame.data.begin());
  }
  return true;
}

size_t SocketCanPort::receive(std::span<Received> frames) noexcept {
  size_t count = 0;
  while (process_ >= 0 && count < frames.size()) {
    constexpr size_t kControl = CMSG_SPACE(3 * sizeof(timespec)) + CMSG_SPACE(sizeof(uint32_t));
    std::array<can_frame, kBatch> raw{};
    std::array<iovec, kBatch> places{};
    std::array<mmsghdr, kBatch> messages{};
    alignas(cmsghdr) std::array<std::array<char, kControl>, kBatch> controls{};
    const size_t room = std::min(kBatch, frames.size() - count);
    for (size_t i = 0; i < room; ++i) {
      places[i] = {&raw[i], sizeof raw[i]};
      messages[i].msg_hdr.msg_iov = &places[i];
      messages[i].msg_hdr.msg_iovlen = 1;
      messages[i].msg_hdr.msg_control = controls[i].data();
      messages[i].msg_hdr.msg_controllen = controls[i].size();
    }
    const int got =
        ::recvmmsg(process_, messages.data(), static_cast<unsigned>(room), MSG_DONTWAIT, nullptr);
    if (got < 0) {
      if (isGone(errno))
        goDown(errno);
      if (errno != EINTR)
        break;
      continue;
    }
    for (size_t i = 0; i < static_cast<size_t>(got); ++i) {
      const Control control = readControl(messages[i].msg_hdr);
      if (control.hasDropped) {
        counters_.dropped += control.dropped - droppedBySocket_;
        droppedBySocket_ = control.dropped;
      }
      if (messages[i].msg_len != sizeof(can_frame))
        continue;
      if (!take(raw[i], (messages[i].msg_hdr.msg_flags & MSG_CONFIRM) != 0, frames[count]))
        continue;
      frames[count++].timeNs = control.timeNs;
    }
    if (static_cast<size_t>(got) < room)
      break;
  }
  return count;
}

int64_t SocketCanPort::monotonicNs() const noexcept { return monotonicNow(); }

int64_t SocketCanPort::utcNs() const noexcept {
  constexpr int64_t kSecondNs = 1'000'000'000;
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return now.tv_sec * kSecondNs + now.tv_nsec;
}

bool SocketCanPort::wait(int64_t monotonicNs) noexcept {
  while (process_ >= 0) {
    const int64_t left = monotonicNs - monotonicNow();
    if (left <= 0)
      return false;
    const timespec time{left / kSecondNs, left % kSecondNs};
    pollfd one{process_, POLLIN, 0};
    const int ready = ::ppoll(&one, 1, &time, nullptr);
    if (ready > 0)
      return true;
    if (ready == 0 || errno != EINTR)
      return false;
  }
  return false;
}

} // namespace stride::can
