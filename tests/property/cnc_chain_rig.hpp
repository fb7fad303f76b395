// Decoder, path processors, velocity check and interpolator as a program calls them: the blocks of
// SM_CNC, each with a queue of its own, called as often and in as odd a rhythm as a test likes.
#ifndef STRIDE_TESTS_PROPERTY_CNC_CHAIN_RIG_HPP
#define STRIDE_TESTS_PROPERTY_CNC_CHAIN_RIG_HPP

#include "runtime/blocks/SM_CNC/cnc_layout.hpp"
#include "tests/support/fresh.hpp"
#include "tests/support/random.hpp"
#include "tests/unit/cnc/gcode_text.hpp"

#include "st/SM_CNC/SMC_CNC_REF.h"
#include "st/SM_CNC/SMC_CheckVelocities.h"
#include "st/SM_CNC/SMC_ExtendedVelocityChecks.h"
#include "st/SM_CNC/SMC_GCODE_WORD.h"
#include "st/SM_CNC/SMC_GEOINFO.h"
#include "st/SM_CNC/SMC_Interpolator.h"
#include "st/SM_CNC/SMC_LimitCircularVelocities.h"
#include "st/SM_CNC/SMC_LimitDynamics.h"
#include "st/SM_CNC/SMC_NCDecoder.h"
#include "st/SM_CNC/SMC_ObjectSplitter.h"
#include "st/SM_CNC/SMC_RotateQueue2D.h"
#include "st/SM_CNC/SMC_RoundPath.h"
#include "st/SM_CNC/SMC_SmoothBSpline.h"
#include "st/SM_CNC/SMC_SmoothMerge.h"
#include "st/SM_CNC/SMC_SmoothPath.h"
#include "st/SM_CNC/SMC_ToolRadiusCorr.h"
#include "st/SM_CNC/SM_CNC_Globals__globals__.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace stride::test {

using OutQueue = ::st::SM_CNC::SMC_OUTQUEUE;
using cnc::PathObject;

/// A path processor as the chain sees it.
struct ProcessorBlock {
  std::function<void(OutQueue *input, bool execute, bool abort)> call;
  std::function<void(bool)> append;
  std::function<bool()> done, busy, failed;
  std::function<OutQueue *()> output;
};

/// A block with memory for so many objects.
template <class Block>
ProcessorBlock processorBlock(size_t places, const std::function<void(Block &)> &set) {
  auto block = std::make_shared<Block>(fresh<Block>());
  auto memory = std::make_shared<std::vector<PathObject>>(places);
  block->nSizeOutQueue = static_cast<uint32_t>(places * sizeof(PathObject));
  block->pbyBufferOutQueue = reinterpret_cast<BYTE *>(memory->data());
  set(*block);
  ProcessorBlock result;
  result.call = [block, memory](OutQueue *input, bool execute, bool abort) {
    Ctx ctx{};
    block->poqDataIn = input;
    block->bExecute = static_cast<BOOL>(execute);
    block->bAbort = static_cast<BOOL>(abort);
    block->body__(ctx);
  };
  result.append = [block](bool appends) { block->bAppend = static_cast<BOOL>(appends); };
  result.done = [block] { return block->bDone != 0; };
  result.busy = [block] { return block->bBusy != 0; };
  result.failed = [block] { return block->bError != 0; };
  result.output = [block] { return block->poqDataOut; };
  return result;
}

/// What SMC_LimitDynamics limits: X, Y, Z, A and P.
inline constexpr uint16_t kLimitedAxes = 0x4F;
inline constexpr double kLimitedVelocity = 30;      // [u/s]
inline constexpr double kLimitedAcceleration = 200; // [u/s^2]

inline ProcessorBlock processorOf(char name, size_t places) {
  namespace decl = ::st::SM_CNC;
  switch (name) {
  case 's':
    return processorBlock<decl::SMC_SmoothPath>(places, [](auto &b) { b.dEdgeDistance = 1; });
  case 'r':
    return processorBlock<decl::SMC_RoundPath>(places, [](auto &b) { b.dRadius = 1; });
  case 'm':
    return processorBlock<decl::SMC_SmoothMerge>(places, [](auto &b) { b.dMaxDeviation = 0.5; });
  case 'x':
    return processorBlock<decl::SMC_ObjectSplitter>(places,
                                                    [](auto &b) { b.dSplittingParameter = 4; });
  case 't':
    return processorBlock<decl::SMC_ToolRadiusCorr>(places, [](auto &b) { b.dToolRadius = 0.5; });
  case 'b':
    return processorBlock<decl::SMC_SmoothBSpline>(places, [](auto & /*b*/) {});
  case 'e':
    return processorBlock<decl::SMC_ExtendedVelocityChecks>(places, [](auto & /*b*/) {});
  case 'l':
    return processorBlock<decl::SMC_LimitDynamics>(places, [](auto &b) {
      b.wAxis = kLimitedAxes;
      b.dMaxVel = kLimitedVelocity;
      b.dMaxAccDec = kLimitedAcceleration;
    });
  case 'R':
    return processorBlock<decl::SMC_RotateQueue2D>(places, [](auto &b) { b.dPhi = 30; });
  default:
    return processorBlock<decl::SMC_LimitCircularVelocities>(places,
                                                             [](auto &b) { b.dMaxAcc = 300; });
  }
}

/// A decoder; `globals` are those of SM_CNC, which lie at the place 0.
inline ::st::SM_CNC::SMC_NCDecoder freshDecoder(::st::SM_CNC::SM_CNC_Globals__globals__ &globals) {
  Ctx ctx{};
  ctx.state = &globals;
  ::st::SM_CNC::SMC_NCDecoder decoder{};
  decoder.init__(ctx);
  return decoder;
}

/// The whole chain.
struct Chain {
  ::st::SM_CNC::SM_CNC_Globals__globals__ globals =
      fresh<::st::SM_CNC::SM_CNC_Globals__globals__>();
  std::vector<cnc::GCodeWord> words;
  ::st::SM_CNC::SMC_CNC_REF program = fresh<::st::SM_CNC::SMC_CNC_REF>();
  std::vector<PathObject> memory;
  std::unique_ptr<::st::SM_CNC::SMC_NCDecoder> decoder =
      std::make_unique<::st::SM_CNC::SMC_NCDecoder>(freshDecoder(globals));
  std::vector<ProcessorBlock> processors;
  ::st::SM_CNC::SMC_CheckVelocities check = fresh<::st::SM_CNC::SMC_CheckVelocities>();
  std::unique_ptr<::st::SM_CNC::SMC_Interpolator> interpolator =
      std::make_unique<::st::SM_CNC::SMC_Interpolator>(fresh<::st::SM_CNC::SMC_Interpolator>());

  Chain(const std::string &text, const std::string &names, const std::vector<size_t> &places)
      : words(cnc::test::scanText(text).words), memory(places.at(0)) {
    program.pgc = reinterpret_cast<::st::SM_CNC::SMC_GCODE_WORD *>(words.data());
    program.nElements = static_cast<uint32_t>(words.size());
    decoder->ncprog = &program;
    decoder->nSizeOutQueue = static_cast<uint32_t>(memory.size() * sizeof(PathObject));
    decoder->pbyBufferOutQueue = reinterpret_cast<BYTE *>(memory.data());
    for (size_t i = 0; i < names.size(); ++i)
      processors.push_back(processorOf(names[i], places.at(i + 1)));
  }

  OutQueue *last() { return processors.empty() ? decoder->poqDataOut : processors.back().output(); }

  void decode(bool execute, bool abort = false) {
    Ctx ctx{};
    decoder->bExecute = static_cast<BOOL>(execute);
    decoder->bAbort = static_cast<BOOL>(abort);
    decoder->body__(ctx);
  }
  void process(size_t i, bool execute, bool abort = false) {
    processors[i].call(i == 0 ? decoder->poqDataOut : processors[i - 1].output(), execute, abort);
  }
  void checkVelocities(bool execute, bool abort = false) {
    Ctx ctx{};
    check.bExecute = static_cast<BOOL>(execute);
    check.bAbort = static_cast<BOOL>(abort);
    check.dAngleTol = 1;
    check.poqDataIn = last();
    check.body__(ctx);
  }
  void interpolate(bool execute, bool abort = false) {
    Ctx ctx{};
    interpolator->bExecute = static_cast<BOOL>(execute);
    interpolator->bAbort = static_cast<BOOL>(abort);
    interpolator->poqDataIn = last();
    interpolator->body__(ctx);
  }
};

/// A program of lines, arcs and splines that hang together, with all that may stand between them.
inline std::string randomPath(Random &random, bool corrected) {
  const auto number = [&](double lo, double hi) {
    return std::to_string(random.uniform(lo, hi)) + " ";
  };
  std::string text =
      "G1 X5 F" + number(20, 200) + "E" + number(200, 3000) + "E-" + number(200, 3000) + "\n";
  if (corrected)
    text += "G41 D1\nG1 X10 Y5\n";
  const int sentences = 3 + random.below(25);
  for (int i = 0; i < sentences; ++i) {
    const int kind = random.below(16);
    if (kind == 0 && !corrected)
      text += "G75\n";
    else if (kind == 1)
      text += "M" + std::to_string(1 + random.below(99)) + "\n";
    else if (kind == 2)
      text += "G4 T0.0" + std::to_string(random.below(9)) + "\n";
    else if (kind == 3)
      text += corrected ? "G51\n" : random.chance(0.5) ? "G51 D2\n" : "G52 D2\n";
    else if (kind == 4)
      text += "G50\n";
    else if (kind == 5)
      text += random.chance(0.5) ? "G91\n" : "G90\n";
    else if (kind == 6)
      text += "G5 X" + number(-20, 20) + "Y" + number(-20, 20) + "\n";
    else if (kind == 7)
      text += "G0 X" + number(-20, 20) + "Y" + number(-20, 20) + "\n";
    else if (kind < 10)
      text += (random.chance(0.5) ? "G2 X" : "G3 X") + number(-20, 20) + "Y" + number(-20, 20) +
              "R" + number(15, 60) + "\n";
    else
      text += "G1 X" + number(-20, 20) + "Y" + number(-20, 20) +
              (random.chance(0.2) ? "H" + std::to_string(1 + random.below(9)) + " O0.5 " : "") +
              (random.chance(0.2) ? "A" + number(-9, 9) : "") +
              (random.chance(0.2) ? "F" + number(20, 200) : "") + "\n";
  }
  if (corrected)
    text += "G40\nG90\nG1 X30 Y0\n";
  return text;
}

} // namespace stride::test

#endif // STRIDE_TESTS_PROPERTY_CNC_CHAIN_RIG_HPP
