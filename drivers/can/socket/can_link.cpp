#include "drivers/can/socket/can_link.hpp"

#include <linux/can/netlink.h>
#include <linux/if_link.h>
#include <linux/netlink.h>
#include <linux/rtnetlink.h>
#include <net/if.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <span>

namespace stride::can {
namespace {

using Bytes = std::span<const uint8_t>;

/// The payload of an attribute of that type; empty: there is none.
Bytes attribute(Bytes bytes, uint16_t type) {
  while (bytes.size() >= sizeof(rtattr)) {
    rtattr head{};
    std::memcpy(&head, bytes.data(), sizeof head);
    if (head.rta_len < sizeof head || head.rta_len > bytes.size())
      return {};
    if ((head.rta_type & NLA_TYPE_MASK) == type)
      return bytes.subspan(sizeof head, head.rta_len - sizeof head);
    const size_t step = RTA_ALIGN(head.rta_len);
    if (step >= bytes.size())
      return {};
    bytes = bytes.subspan(step);
  }
  return {};
}

template <class T> bool read(Bytes bytes, T &value) {
  if (bytes.size() < sizeof value)
    return false;
  std::memcpy(&value, bytes.data(), sizeof value);
  return true;
}

ControllerState stateOf(uint32_t state) {
  switch (state) {
  case CAN_STATE_ERROR_ACTIVE:
    return ControllerState::Active;
  case CAN_STATE_ERROR_WARNING:
    return ControllerState::Warning;
  case CAN_STATE_ERROR_PASSIVE:
    return ControllerState::Passive;
  case CAN_STATE_BUS_OFF:
    return ControllerState::BusOff;
  default:
    return ControllerState::Down;
  }
}

struct Request {
  nlmsghdr head{};
  ifinfomsg info{};
};

} // namespace

CanLink parseLink(const void *answer, size_t size) noexcept {
  CanLink link;
  const Bytes bytes(static_cast<const uint8_t *>(answer), size);
  nlmsghdr head{};
  ifinfomsg info{};
  if (!read(bytes, head) || head.nlmsg_type != RTM_NEWLINK || head.nlmsg_len > size ||
      head.nlmsg_len < NLMSG_HDRLEN + sizeof info || !read(bytes.subspan(NLMSG_HDRLEN), info))
    return link;
  link.known = true;
  link.isUp = (info.ifi_flags & IFF_UP) != 0;
  const size_t first = NLMSG_HDRLEN + NLMSG_ALIGN(sizeof info);
  if (first >= head.nlmsg_len)
    return link;
  const Bytes attributes = bytes.subspan(first, head.nlmsg_len - first);
  const Bytes data = attribute(attribute(attributes, IFLA_LINKINFO), IFLA_INFO_DATA);
  can_bittiming timing{};
  if (read(attribute(data, IFLA_CAN_BITTIMING), timing))
    link.bitRate = timing.bitrate;
  uint32_t state = 0;
  link.hasState = read(attribute(data, IFLA_CAN_STATE), state);
  if (link.hasState)
    link.state = stateOf(state);
  return link;
}

CanLink readLink(unsigned index) noexcept {
  const int fd = ::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE);
  if (fd < 0)
    return {};
  Request request;
  request.head.nlmsg_len = sizeof request;
  request.head.nlmsg_type = RTM_GETLINK;
  request.head.nlmsg_flags = NLM_F_REQUEST;
  request.info.ifi_family = AF_UNSPEC;
  request.info.ifi_index = static_cast<int>(index);
  CanLink link;
  constexpr size_t kMost = 16384;
  std::array<uint8_t, kMost> answer; // NOLINT(cppcoreguidelines-pro-type-member-init)
  // The kernel answers within send().
  if (::send(fd, &request, sizeof request, 0) == static_cast<ssize_t>(sizeof request)) {
    const ssize_t size = ::recv(fd, answer.data(), answer.size(), MSG_DONTWAIT);
    if (size > 0)
      link = parseLink(answer.data(), static_cast<size_t>(size));
  }
  ::close(fd);
  return link;
}

} // namespace stride::can
