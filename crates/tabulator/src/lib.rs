//! Fills kernel tables of the elastic half-space.
