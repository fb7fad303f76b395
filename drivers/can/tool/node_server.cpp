#include "drivers/can/tool/node_server.hpp"

#include "drivers/can/tool/bus_client.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace stride::can::tool {

NodeServer::NodeServer(Port &port, std::vector<simulation::Node *> nodes)
    : port_(port), nodes_(std::move(nodes)) {}

void NodeServer::powerOn(int64_t nowNs) {
  for (simulation::Node *node : nodes_)
    node->powerOn(nowNs);
  flush(nowNs);
}

/// Nodes hear each other as well.
void NodeServer::send(simulation::Node &from, const Frame &frame, int64_t nowNs) {
  if (port_.send(frame, SendClass::Process) != SendResult::Sent)
    ++lost_;
  for (simulation::Node *node : nodes_)
    if (node != &from)
      node->receive(frame, nowNs);
}

void NodeServer::flush(int64_t nowNs) {
  // What one sends may let another one send.
  for (bool more = true; more;) {
    more = false;
    for (simulation::Node *node : nodes_)
      for (Frame frame; node->transmit(frame); more = true)
        send(*node, frame, nowNs);
  }
}

void NodeServer::serve(int64_t untilNs) {
  int64_t next = untilNs;
  for (const simulation::Node *node : nodes_)
    next = std::min(next, node->nextNs());
  port_.wait(next);
  std::array<Received, 32> frames;
  const size_t count = port_.receive(frames);
  const int64_t now = monotonicNow();
  for (simulation::Node *node : nodes_)
    node->advance(now);
  for (size_t i = 0; i < count; ++i) {
    for (simulation::Node *node : nodes_)
      node->receive(frames[i].frame, now);
    flush(now);
  }
  flush(now);
}

} // namespace stride::can::tool
