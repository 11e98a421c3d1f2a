//! Random streams are independent, and every random number of the bench comes from one.

mod correlation;
mod reference;
mod sources;
