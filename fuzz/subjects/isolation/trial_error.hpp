// Errors that end a plug-in's trial, but are not the plug-in's fault.
#pragma once

#include "ccd/query/error.hpp"

namespace nearmiss::isolation {

/// Thrown if no more answers can be collected, for a reason that the plug-in's code has not caused.
class TrialError : public Error {
 public:
  using Error::Error;
};

/// Thrown if the system does not start a worker process, for example because the user has too many processes.
class NoWorker : public TrialError {
 public:
  using TrialError::TrialError;
};

}  // namespace nearmiss::isolation
