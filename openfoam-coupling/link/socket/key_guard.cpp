// SPDX-FileCopyrightText: Eccentra contributors
// SPDX-License-Identifier: GPL-3.0-or-later
// Answers ZeroMQ's questions about keys.
#include "link/socket/key_guard.h"

#include <zmq.hpp>

#include <signal.h>

#include <array>
#include <cstring>
#include <thread>
#include <vector>

namespace eccentra::link {
namespace {

constexpr std::size_t kKeyBytes = 32;
/// Frames of a question: version, request id, domain, address, routing id, mechanism, and the key.
constexpr std::size_t kQuestionFrames = 7;
const char* const kQuestions = "inproc://zeromq.zap.01";
const char* const kStop = "inproc://eccentra-key-guard-stop";

} // namespace

struct KeyGuard::State {
  std::array<std::uint8_t, kKeyBytes> allowed{};
  zmq::socket_t questions;
  zmq::socket_t stop_here, stop_there;
  std::thread thread;

  explicit State(zmq::context_t& context)
      : questions(context, zmq::socket_type::rep), stop_here(context, zmq::socket_type::pair),
        stop_there(context, zmq::socket_type::pair) {}

  void answer() {
    std::vector<zmq::message_t> frames;
    do {
      frames.emplace_back();
      (void)questions.recv(frames.back(), zmq::recv_flags::none);
    } while (frames.back().more());
    const bool known = frames.size() == kQuestionFrames && frames[5].to_string() == "CURVE" &&
                       frames[6].size() == kKeyBytes && std::memcmp(frames[6].data(), allowed.data(), kKeyBytes) == 0;
    const std::string id = frames.size() > 1 ? frames[1].to_string() : "";
    const std::string reply[] = {"1.0", id, known ? "200" : "400", known ? "" : "unknown key", "", ""};
    for (std::size_t k = 0; k < std::size(reply); ++k)
      questions.send(zmq::buffer(reply[k]),
                     k + 1 < std::size(reply) ? zmq::send_flags::sndmore : zmq::send_flags::none);
  }

  void serve() {
    for (;;) {
      zmq_pollitem_t items[] = {{questions.handle(), 0, ZMQ_POLLIN, 0}, {stop_there.handle(), 0, ZMQ_POLLIN, 0}};
      if (zmq_poll(items, 2, -1) < 0 && zmq_errno() != EINTR)
        return;
      if (items[1].revents)
        return;
      if (items[0].revents)
        answer();
    }
  }
};

KeyGuard::KeyGuard(zmq::context_t& context, const std::string& allowed_public)
    : state_(std::make_unique<State>(context)) {
  zmq_z85_decode(state_->allowed.data(), allowed_public.c_str());
  state_->questions.bind(kQuestions);
  state_->stop_here.bind(kStop);
  state_->stop_there.connect(kStop);
  // Signals are for the thread that computes.
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  state_->thread = std::thread([this] { state_->serve(); });
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

KeyGuard::~KeyGuard() {
  try {
    state_->stop_here.send(zmq::str_buffer("stop"), zmq::send_flags::none);
  } catch (const zmq::error_t&) {
    // The thread ends with the context.
  }
  state_->thread.join();
}

} // namespace eccentra::link
