#include "tests/bench/st/twin.h"

namespace {

struct Node {
  Node *next;
  int32_t key;
  uint32_t hits;
};

struct Counter {
  uint32_t total;

  void count(Node &node, int32_t limit) {
    if (node.key < limit) {
      ++node.hits;
      total += node.hits;
    }
  }
};

struct Plc {
  Node nodes[256];
  Node *head;
  Counter counter;
  int64_t checksum;

  void init() {}

  void cycle(int64_t) {
    if (head == nullptr) {
      for (int32_t i = 0; i < 256; ++i) {
        nodes[i].key = i * 73 % 256;
        nodes[i].next = head;
        head = &nodes[i];
      }
    }
    int64_t sum = 0;
    for (Node *p = head; p != nullptr; p = p->next) {
      sum += p->key;
      counter.count(*p, 128);
    }
    checksum += sum + counter.total;
  }
};

} // namespace

STRIDE_TWIN(Plc)
