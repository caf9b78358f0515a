//! Kernel tables of the elastic half-space: format, loading, interpolation.
