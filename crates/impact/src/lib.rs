//! Impact of a body on an elastic half-space.
