//! Responses of sensors.

use crate::errors::{plain, raise};
use crate::values::{frozen, numbers, vector};
use formats::read_response;
use impact::response::{Fir, PolesZeros, Response as Own, ResponseError, Tabulated};
use num_complex::Complex64;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;
use std::path::PathBuf;

/// A response of a sensor.
#[pyclass(module = "hertzlamb._core", frozen)]
pub(crate) struct Response(Own);

fn made(found: Result<Own, ResponseError>) -> PyResult<Response> {
    found.map(Response).map_err(raise)
}

#[pymethods]
impl Response {
    #[staticmethod]
    fn poles_zeros(poles: Vec<Complex64>, zeros: Vec<Complex64>, gain: f64) -> PyResult<Self> {
        made(PolesZeros::new(poles, zeros, gain).map(Own::PolesZeros))
    }

    #[staticmethod]
    fn table(
        frequencies_hz: PyReadonlyArray1<'_, f64>,
        amplitudes: PyReadonlyArray1<'_, f64>,
        phases_rad: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<Self> {
        let phases_rad = phases_rad.as_ref().map(numbers);
        let found = Tabulated::new(numbers(&frequencies_hz), numbers(&amplitudes), phases_rad);
        made(found.map(Own::Tabulated))
    }

    #[staticmethod]
    fn filter(coefficients: PyReadonlyArray1<'_, f64>, rate_hz: f64) -> PyResult<Self> {
        made(Fir::new(numbers(&coefficients), rate_hz).map(Own::Fir))
    }

    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        read_response(&path).map(Self).map_err(raise)
    }

    /// "poles_zeros", "table" or "filter".
    #[getter]
    fn kind(&self) -> &'static str {
        match self.0 {
            Own::PolesZeros(_) => "poles_zeros",
            Own::Tabulated(_) => "table",
            Own::Fir(_) => "filter",
        }
    }

    #[getter]
    fn is_minimum_phase(&self) -> bool {
        self.0.is_minimum_phase()
    }

    #[getter]
    fn limits_hz(&self) -> [f64; 2] {
        self.0.limits_hz()
    }

    /// Complex values at frequencies.
    fn at<'py>(
        &self,
        py: Python<'py>,
        frequencies_hz: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let found: Vec<Complex64> = numbers(&frequencies_hz)
            .into_iter()
            .map(|frequency_hz| self.0.at(frequency_hz))
            .collect();
        let shape = [found.len()];
        Ok(frozen(py, found, &shape)?.into_any())
    }

    /// Output, its error at each sample, and the largest gain of an error of the input.
    fn apply<'py>(
        &self,
        py: Python<'py>,
        step_s: f64,
        samples: PyReadonlyArray1<'_, f64>,
    ) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyAny>, f64)> {
        let found = self.0.apply(step_s, &numbers(&samples)).map_err(raise)?;
        let [output, error] = [found.samples, found.error].map(|own| vector(py, own));
        Ok((output?.into_any(), error?.into_any(), found.largest_gain))
    }

    /// The input in a band.
    fn remove<'py>(
        &self,
        py: Python<'py>,
        step_s: f64,
        samples: PyReadonlyArray1<'_, f64>,
        band_hz: Vec<f64>,
    ) -> PyResult<Bound<'py, PyAny>> {
        let Ok(band_hz) = <[f64; 4]>::try_from(band_hz) else {
            return Err(plain(
                "DomainError",
                "band_hz needs four frequencies in ascending order",
            ));
        };
        let found = self.0.remove(step_s, &numbers(&samples), band_hz);
        Ok(vector(py, found.map_err(raise)?)?.into_any())
    }
}
