#include "drivers/can/master/parameter_transfer.hpp"

#include "drivers/can/master/texts.hpp"
#include "runtime/iec/math.h"

#include <algorithm>

namespace stride::can {
namespace {

using bus::ParameterAnswer;
using bus::ParameterForm;
using bus::ParameterRequest;
using Result = ParameterAnswer::Result;

constexpr size_t kMostNumberBytes = 8;
constexpr size_t kRawBytes = 4;

/// For each AbortMeaning.
constexpr std::array<Result, 4> kResults = {Result::Failed, Result::Unknown, Result::ReadOnly,
                                            Result::Refused};

/// Objects of a drive's configuration that outlast its use: what is set in every cycle or at
/// start-up by the driver is not among them. [CiA 402]
constexpr std::array<Object, 44> kUsual = {{
    {0x6007, 0}, {0x605A, 0}, {0x605B, 0}, {0x605C, 0}, {0x605D, 0}, {0x605E, 0}, {0x6065, 0},
    {0x6066, 0}, {0x6067, 0}, {0x6068, 0}, {0x606D, 0}, {0x606E, 0}, {0x606F, 0}, {0x6070, 0},
    {0x6072, 0}, {0x6073, 0}, {0x607C, 0}, {0x607D, 1}, {0x607D, 2}, {0x607E, 0}, {0x607F, 0},
    {0x6080, 0}, {0x6081, 0}, {0x6083, 0}, {0x6084, 0}, {0x6085, 0}, {0x6086, 0}, {0x6087, 0},
    {0x608F, 1}, {0x608F, 2}, {0x6090, 1}, {0x6090, 2}, {0x6091, 1}, {0x6091, 2}, {0x6092, 1},
    {0x6092, 2}, {0x6098, 0}, {0x6099, 1}, {0x6099, 2}, {0x609A, 0}, {0x60C5, 0}, {0x60C6, 0},
    {0x60E0, 0}, {0x60E1, 0},
}};

uint64_t wordOf(std::span<const uint8_t> bytes) {
  uint64_t word = 0;
  for (size_t i = 0; i < bytes.size(); ++i)
    word |= uint64_t{bytes[i]} << 8 * i;
  return word;
}

/// A number of that many bytes, with its sign where the object has one.
double numberOf(uint64_t word, size_t size, bool isSigned) {
  const size_t unused = 64 - 8 * size;
  if (isSigned)
    return static_cast<double>(static_cast<int64_t>(word << unused) >> unused);
  return static_cast<double>(word);
}

/// The bits of a number, if the object can hold it. Of an object that is not known, numbers with
/// and without a sign are taken.
bool bitsOf(double value, size_t size, const ObjectForm &form, uint64_t &word) {
  const double whole = stride::floor(value + 0.5);
  const double range = stride::pow(2.0, 8.0 * static_cast<double>(size));
  const bool known = form.bytes != 0;
  const double least = known && !form.isSigned ? 0 : -range / 2;
  const double most = known && form.isSigned ? range / 2 - 1 : range - 1;
  if (!(whole >= least && whole <= most))
    return false;
  word =
      whole < 0 ? static_cast<uint64_t>(static_cast<int64_t>(whole)) : static_cast<uint64_t>(whole);
  return true;
}

/// Raw bits of a narrower object: what is cut off is nothing, or a sign.
bool fitsRaw(uint32_t raw, size_t size) {
  if (size >= kRawBytes)
    return true;
  const uint32_t above = raw >> (8 * size - 1);
  return above >> 1U == 0 || above == UINT32_MAX >> (8 * size - 1);
}

} // namespace

std::optional<Object> objectOfParameter(int32_t number) {
  constexpr int32_t kMost = 0xFFFFFF;
  if (number <= 0 || number > kMost)
    return std::nullopt;
  return Object{static_cast<uint16_t>(number >> 8), static_cast<uint8_t>(number & 0xFF)};
}

int32_t parameterOf(Object object) { return object.index * 256 + object.sub; }

ParameterTransfer::ParameterTransfer(std::span<const SdoWrite> listed, uint8_t axis) : axis_(axis) {
  listed_.reserve(listed.size() + kUsual.size());
  for (const SdoWrite &one : listed)
    if (one.bytes.empty()) // a parameter has 32 bits
      list(one.object, There::Yes);
  for (const Object object : kUsual)
    list(ofAxis(object, axis), There::Unknown);
}

void ParameterTransfer::list(Object object, There there) {
  const bool known = std::any_of(listed_.begin(), listed_.end(),
                                 [object](const Listed &one) { return one.object == object; });
  if (!known)
    listed_.push_back({object, std::string(std::string_view(ObjectText(object))), there});
}

void ParameterTransfer::start(const ParameterRequest &request) {
  request_ = request;
  answer_ = {};
  step_ = Step::Asked;
  if (request.kind == ParameterRequest::Kind::Describe) {
    describe();
    return;
  }
  const std::optional<Object> object = objectOfParameter(request.number);
  if (object)
    object_ = *object;
  else
    answer(Result::Unknown);
}

/// The place counts among those that the node has: it is asked where that is not known yet.
void ParameterTransfer::describe() {
  const bool asked = (request_.forms & formBit(ParameterForm::Number)) != 0;
  int32_t left = request_.number;
  for (size_t i = 0; asked && left >= 0 && i < listed_.size(); ++i) {
    const Listed &one = listed_[i];
    if (one.there == There::Unknown) {
      probe_ = i;
      object_ = one.object;
      step_ = Step::Asked;
      return;
    }
    if (one.there == There::No || left-- > 0)
      continue;
    answer_.number = parameterOf(one.object);
    answer_.type = ParameterAnswer::Type::Whole;
    answer_.writable = true;
    answer_.name = one.name;
    answer(Result::Done);
    return;
  }
  answer(Result::Unknown);
}

void ParameterTransfer::probed(bool there) {
  listed_[probe_].there = there ? There::Yes : There::No;
  describe();
}

void ParameterTransfer::answer(Result result) {
  answer_.result = result;
  step_ = Step::Answered;
}

bool ParameterTransfer::poll(ParameterAnswer &answer) {
  if (step_ != Step::Answered)
    return false;
  answer = answer_;
  step_ = Step::Idle;
  return true;
}

void ParameterTransfer::cancel(SdoClient &sdo) {
  if (step_ == Step::Reading || step_ == Step::Measuring || step_ == Step::Writing ||
      step_ == Step::Probing)
    sdo.cancel();
  step_ = Step::Idle;
}

void ParameterTransfer::clear() {
  if (step_ != Step::Idle)
    answer(Result::Failed);
}

void ParameterTransfer::begin(SdoClient &sdo) {
  if (request_.kind == ParameterRequest::Kind::Describe) {
    if (sdo.upload(object_, std::span<uint8_t>(bytes_).first(kMostNumberBytes)))
      step_ = Step::Probing;
    return;
  }
  const bool writes = request_.kind == ParameterRequest::Kind::Write;
  if (writes && request_.form == ParameterForm::Bytes) {
    write(sdo, request_.bytes.size());
    return;
  }
  // A write needs the object's size: what is known, else what the node says.
  const ObjectForm form = formOf(inProfile(object_, axis_));
  if (writes && form.bytes != 0) {
    write(sdo, form.bytes);
    return;
  }
  const size_t room =
      writes || request_.form != ParameterForm::Bytes ? kMostNumberBytes : bytes_.size();
  if (sdo.upload(object_, std::span<uint8_t>(bytes_).first(room)))
    step_ = writes ? Step::Measuring : Step::Reading;
}

bool ParameterTransfer::encode(size_t size) {
  if (size == 0 || size > kMostNumberBytes)
    return false;
  uint64_t word = 0;
  switch (request_.form) {
  case ParameterForm::Bool:
    word = request_.value != 0 ? 1 : 0;
    break;
  case ParameterForm::Raw:
    if (size > kRawBytes || !fitsRaw(request_.raw, size))
      return false;
    word = request_.raw;
    break;
  default:
    if (!bitsOf(request_.value, size, formOf(inProfile(object_, axis_)), word))
      return false;
    break;
  }
  for (size_t i = 0; i < size; ++i)
    bytes_[i] = static_cast<uint8_t>(word >> 8 * i);
  return true;
}

void ParameterTransfer::write(SdoClient &sdo, size_t size) {
  if (request_.form == ParameterForm::Bytes)
    std::copy(request_.bytes.bytes().begin(), request_.bytes.bytes().end(), bytes_.begin());
  if ((request_.form != ParameterForm::Bytes && !encode(size)) || size == 0) {
    answer(Result::Refused);
    return;
  }
  if (sdo.download(object_, std::span<const uint8_t>(bytes_).first(size)))
    step_ = Step::Writing;
}

void ParameterTransfer::read(size_t size) {
  const std::span<const uint8_t> bytes = std::span<const uint8_t>(bytes_).first(size);
  const size_t most = request_.form == ParameterForm::Raw ? kRawBytes : kMostNumberBytes;
  if (request_.form == ParameterForm::Bytes) {
    answer_.bytes.assign(bytes);
  } else if (size == 0 || size > most) {
    answer(Result::Unknown); // it is no number
    return;
  } else {
    const uint64_t word = wordOf(bytes);
    answer_.raw = static_cast<uint32_t>(word);
    answer_.value = request_.form == ParameterForm::Bool
                        ? (word != 0 ? 1.0 : 0.0)
                        : numberOf(word, size, formOf(inProfile(object_, axis_)).isSigned);
  }
  answer(Result::Done);
}

void ParameterTransfer::aborted(const SdoClient &sdo) {
  const uint32_t code = sdo.abortCode();
  const bool noNumber = code == abort_code::kMemory && request_.form != ParameterForm::Bytes;
  answer(noNumber ? Result::Unknown : kResults[static_cast<size_t>(abortRow(code).meaning)]);
}

void ParameterTransfer::finished(SdoClient &sdo) {
  if (step_ == Step::Probing) {
    const bool done = sdo.state() == SdoClient::State::Done;
    if (!done && !isMissing(sdo.abortCode()))
      aborted(sdo);
    else
      probed(done && sdo.size() > 0 && sdo.size() <= kRawBytes);
    return;
  }
  if (step_ != Step::Reading && step_ != Step::Measuring && step_ != Step::Writing)
    return; // it has been given up
  if (sdo.state() != SdoClient::State::Done) {
    aborted(sdo);
    return;
  }
  switch (step_) {
  case Step::Reading:
    read(sdo.size());
    break;
  case Step::Measuring:
    write(sdo, sdo.size());
    break;
  case Step::Writing:
    answer(Result::Done);
    break;
  default:
    break;
  }
}

} // namespace stride::can
