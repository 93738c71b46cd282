//! What the sigmoid law loses at rest.

use std::f64::consts::PI;
use std::fmt;

use crate::{DuctedCable, End, FrictionLaw, MovingDuct};

/// Share of stored force lost in one pass from which the leak matters.
const LOSS: f64 = 0.01;
/// Reference speed relative to the duct's velocity from which friction is viscous.
const VISCOUS: f64 = 0.1;
/// Spreading length relative to the duct's natural length from which the gain of a pass fades.
const SPREAD: f64 = 0.5;

/// What the sigmoid law loses at rest: a warning to show, when it [matters](SigmoidLeak::matters).
///
/// f = q tanh(b Δs/2) with Δs the slip within Δt is, for slow slip, a dashpot: f = η ṡ with the drag
///
/// η = q b Δt/2 = q/v_b \[N·s/m²\],  v_b = 2/(b Δt) the reference speed.
///
/// A cable at rest in a still duct therefore creeps back, η u̇ = EA u″: a diffusion that forgets every stored force. Its
/// slowest mode, of wave number z/L, decays with
///
/// τ = η L²/(z² EA),
///
/// where z = atan(s₀/z) + atan(s₁/z) and s = S L/EA are the ends' stiffnesses: z = π/2 for one end fixed and one free, π
/// for both fixed (H. S. Carslaw, J. C. Jaeger, Conduction of Heat in Solids, 1959, §3.9). With both ends free that mode
/// is a rigid motion without force, and the next one, z = π, counts.
///
/// A pass lasts T: the time in which the vehicle is followed, and the two steps from rest and to
/// it, which begin with the law's slope and forget their friction as a step Δt does.
///
/// Forces locked into a short stretch fade sooner: in the time T of a pass they spread by ℓ = √(EA T/η). Just after a pass
/// the gain stands within a few depths of the ends and of the vehicle's trace, so that this length relative to the duct's natural
/// length decides, long before e^(−T/τ) is felt: measured on the 30 m scene, 67 % of the force of two passes is
/// missing at ℓ = 6 m, 21 % at 1.9 m, 3 % at 0.6 m and 0.3 % at 0.2 m.
///
/// The time step counts only in the product b Δt. Force after two passes on that scene with b = 1e8 1/m, implicit, where
/// Coulomb's law gives 139 N:
///
/// | Δt, ms | 18 | 9 | 4.5 | 2.25 |
/// |---|---|---|---|---|
/// | force, N | 122 | 110 | 94 | 73 |
///
/// Both v_b and τ contain Δt: the answer depends on the time step as much as on the cable. A short Δt leaks fast and
/// lets the reference speed grow past the duct's own velocity, so that friction never reaches its limit; a long Δt does not
/// resolve the passing. Clamps along the cable are left out of z: they only shorten the part that leaks.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SigmoidLeak {
    /// v_b = 2/(b Δt) \[m/s\]: slip below this speed is viscous.
    pub reference_speed: f64,
    /// η = q/v_b \[N·s/m²\].
    pub drag: f64,
    /// τ \[s\]: stored force decays as e^(−t/τ).
    pub relaxation_time: f64,
    /// Share of the stored force that a cable at rest loses in the time of one pass.
    pub loss_per_pass: f64,
    /// v_b over the largest velocity of the duct.
    pub speed_ratio: f64,
    /// ℓ = √(EA T/η) \[m\], by which locked forces spread in the time T of one pass.
    pub spread: f64,
    /// ℓ over the duct's natural length: its largest displacement over its steepest slope.
    pub spread_ratio: f64,
}

impl SigmoidLeak {
    /// The leak of `cable` in a pass of `duct` with steps of `time_step` \[s\]; `None` for a law
    /// with memory and without friction.
    pub fn new(cable: &DuctedCable, time_step: f64, duct: &MovingDuct) -> Option<Self> {
        let FrictionLaw::Sigmoid { shape_factor } = cable.friction().law() else {
            return None;
        };
        if cable.friction().limit() == 0.0 {
            return None;
        }
        let reference_speed = 2.0 / (shape_factor * time_step);
        let drag = cable.friction().limit() / reference_speed;
        let length = cable.length() / slowest_wave_number(cable);
        let relaxation_time = drag * length * length / cable.axial_stiffness();
        let duration = duct.duration() + 2.0 * time_step;
        let spread = (cable.axial_stiffness() * duration / drag).sqrt();
        Some(Self {
            spread,
            spread_ratio: spread * duct.steepest / duct.peak(),
            reference_speed,
            drag,
            relaxation_time,
            loss_per_pass: -(-duration / relaxation_time).exp_m1(),
            speed_ratio: reference_speed / (duct.steepest * duct.speed()),
        })
    }

    /// Whether the answer depends on the time step: more than 1 % of the stored force is lost in a pass, locked forces
    /// spread over half the duct's natural length, or friction stays viscous (v_b above a tenth of the duct's velocity).
    pub fn matters(&self) -> bool {
        // Written so that NaN matters.
        !(self.loss_per_pass <= LOSS && self.speed_ratio <= VISCOUS && self.spread_ratio <= SPREAD)
    }
}

impl fmt::Display for SigmoidLeak {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "sigmoid friction depends on the time step: viscous below {:.1e} m/s ({:.1e} of the duct's velocity), locked forces \
             spread by {:.2} m in one pass at rest, and decay in {:.3} s, {:.1} % in one pass",
            self.reference_speed,
            self.speed_ratio,
            self.spread,
            self.relaxation_time,
            100.0 * self.loss_per_pass,
        )
    }
}

/// z: the first root of z = atan(s₀/z) + atan(s₁/z), or π where both ends are free.
fn slowest_wave_number(cable: &DuctedCable) -> f64 {
    let relative = |end: End| match end.stiffness() {
        Some(stiffness) => stiffness * cable.length() / cable.axial_stiffness(),
        None => f64::INFINITY,
    };
    let (s0, s1) = (relative(cable.upstream()), relative(cable.downstream()));
    if s0 == 0.0 && s1 == 0.0 {
        return PI;
    }
    let (mut low, mut high) = (0.0, PI);
    for _ in 0..60 {
        let z = 0.5 * (low + high);
        if z < (s0 / z).atan() + (s1 / z).atan() {
            low = z;
        } else {
            high = z;
        }
    }
    high
}
