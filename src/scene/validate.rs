//! The checks of a scene file, for a scene that a program made or changed.

use super::data::{Order, Scene};
use super::error::SceneError;
use super::file::SceneFile;
use super::range::shown;

/// How far a share may be from what it has to be.
const ROUNDING: f64 = 1e-9;

impl Scene {
    /// Checks everything that reading a scene file checks. What computes with a scene does so first.
    ///
    /// ```
    /// use creepage::Scene;
    ///
    /// let mut scene = Scene::from_file("examples/scenes/full-scale-upper.toml")?;
    /// scene.validate()?;
    /// scene.duct.depth = -1.0;
    /// let error = scene.validate().unwrap_err().to_string();
    /// assert!(error.starts_with("`duct.depth`: out of range: found \"-1.0 m\"; allowed: a length greater than 0, from 1 cm to 1 km"));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    ///
    /// [`SceneError::Wrong`] with the first key whose value is out of its range or contradicts another one.
    pub fn validate(&self) -> Result<(), SceneError> {
        if let Order::Sequence(sequence) = &self.traffic.order {
            let count = self.vehicles.len();
            if let Some(index) = sequence.iter().find(|&&index| index >= count) {
                let allowed = format!("a vehicle's index, less than {count}");
                return Err(SceneError::value("traffic.sequence", index.to_string(), allowed));
            }
        }
        // A scene is valid if a file can hold it.
        let read = SceneFile::from_toml("scene", &self.to_toml()).and_then(|file| file.scene());
        let read = read.map_err(SceneError::without_location)?;
        for (index, (one, other)) in self.vehicles.iter().zip(&read.vehicles).enumerate() {
            if (one.share - other.share).abs() > ROUNDING {
                let allowed = format!(
                    "{}, with which all shares sum to 1 and suit a sequence",
                    shown(other.share)
                );
                let key = format!("vehicles.{index}.share");
                return Err(SceneError::value(key, shown(one.share), allowed));
            }
        }
        Ok(())
    }
}
