#include "interrupt.hpp"

#include <utility>

namespace tilth::python {

namespace nb = nanobind;

Interrupt::~Interrupt() {
  Py_XDECREF(raised_);
}

bool Interrupt::came() {
  if (stop_ || std::this_thread::get_id() != caller_) return stop_;
  const nb::gil_scoped_acquire locked;
  if (PyErr_CheckSignals() == 0) return false;
  nb::python_error error;  // takes what the handler raised
  keep(error);
  return true;
}

void Interrupt::keep(nb::python_error& error) {
  stop_ = true;
  if (raised_ == nullptr) raised_ = nb::object(nb::borrow(error.value())).release().ptr();
}

void Interrupt::raise() {
  if (raised_ == nullptr) return;
  stop_ = false;
  const nb::object exception = nb::steal(std::exchange(raised_, nullptr));
  PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(exception.ptr())), exception.ptr());
  throw nb::python_error();
}

}  // namespace tilth::python
