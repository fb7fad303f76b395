#include "tests/bench/st/twin.h"

#include <new>

namespace {

class Shape {
public:
  virtual double area() const = 0;
  virtual void grow(double factor) = 0;

protected:
  ~Shape() = default;
};

class Square final : public Shape {
public:
  double area() const override { return side_ * side_; }
  void grow(double factor) override { side_ *= factor; }

private:
  double side_ = 1.0;
};

class Box final : public Shape {
public:
  double area() const override { return width_ * height_; }
  void grow(double factor) override {
    width_ *= factor;
    height_ /= factor;
  }

private:
  double width_ = 2.0;
  double height_ = 3.0;
};

struct Totals {
  double sum;
  void add(double value) { sum = sum / 2.0 + value; }
};

struct Plc {
  alignas(Square) unsigned char squares[32][sizeof(Square)];
  alignas(Box) unsigned char boxes[32][sizeof(Box)];
  Shape *shapes[64];
  Totals totals;
  double factor;
  double checksum;

  void init() {
    for (int i = 0; i < 32; ++i) {
      shapes[2 * i] = new (squares[i]) Square;
      shapes[2 * i + 1] = new (boxes[i]) Box;
    }
    factor = 1.01;
  }

  void cycle(int64_t) {
    factor = 1.0 / factor;
    for (Shape *shape : shapes) {
      shape->grow(factor);
      totals.add(shape->area());
    }
    checksum = checksum / 4.0 + totals.sum;
  }
};

} // namespace

STRIDE_TWIN(Plc)
