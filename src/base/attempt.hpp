// Work of which a failure is entered, so that it does not end a batch.
#pragma once

#include <stdexcept>

#include "stickslip/base/error.hpp"

namespace stickslip::detail {

/// Does `work`; calls `failed` with the message if one of the errors of `integrate` ends it.
template <class Work, class Failed>
void attempt(Work&& work, Failed&& failed) {
  try {
    work();
  } catch (const ConvergenceError& error) {
    failed(error.what());
  } catch (const std::overflow_error& error) {
    failed(error.what());
  } catch (const std::invalid_argument& error) {
    failed(error.what());
  }
}

}  // namespace stickslip::detail
