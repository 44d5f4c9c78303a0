<!DOCTYPE PickedPoints>
<PickedPoints>
 <point x="1" y="-2.5" z="3" name="chin" active="1"/>
 <point x="4" y="5" z="6" name="nose" active="0"/>
</PickedPoints>
